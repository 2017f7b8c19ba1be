#pragma once

#include <memory>
#include <string>
#include <variant>

#include "state/app_state.h"

namespace lapwing::viewer {

/// The part of the selection that a command changes.
struct Part {
  enum class Role { roi, handle, belt };
  Role role = Role::roi;
  std::size_t handle = 0;  ///< index from 0; equal to the number of handles for a new handle

  bool operator==(const Part&) const = default;
};

/// Replaces the part of the selection by a region.
struct Choose {
  Part part;
  RegionSpec region;
  std::optional<Falloff> falloff = {};  ///< of a handle; if not set, the falloff does not change
};

/// Adds vertices to the part and removes others: a brush stroke, a lasso, grow, shrink, invert.
struct Paint {
  Part part;
  VertexSet added;
  VertexSet removed;
};

/// Adds vertices to the ROI of the open edit. Unlike Paint, this does not commit: the handles'
/// moves stay.
struct EnlargeRoi {
  VertexSet added;
};

/// Begins another edit with this region and one handle.
struct Grab {
  ChosenRegion roi;
  RegionSpec handle;
  Falloff falloff;
};

/// Sets the weight and the falloff of the handle.
struct SetFalloff {
  std::size_t handle = 0;
  Falloff falloff;
};

struct RemoveHandle {
  std::size_t handle = 0;
};

/// Sets the width of the belt as a fraction of the ROI's radius. Replaces a belt chosen by hand.
struct SetBeltWidth {
  double fraction = BoundaryAnchors{}.fraction;
};

/// Turns mirroring on, or off if there is no plane.
struct SetMirror {
  std::optional<MirrorPlane> plane;
};

/// Sets the stiffness of parts of the surface.
struct SetStiffness {
  std::vector<StiffnessSpec> parts;
};

/// Sets the handle's move from its rest position. `to.path` contains the waypoints since the
/// handle's last move; they are added to the path in the state (`extend_path`).
struct MoveHandle {
  std::size_t handle = 0;
  HandleMove to;
};

/// Sets the moves of all handles from their rest positions, and replaces their paths.
struct MoveHandles {
  std::vector<HandleMove> to;  ///< one per handle
};

/// Sets the settled surface of the current moves, which the caller has computed.
struct Settle {
  std::shared_ptr<const MovedVertices> result;
};

/// Makes the settled surface the rest shape of the next edit.
struct Commit {};

/// Commits, clears the selection and begins a new edit. Parameters, mirror plane and belt width
/// stay the same.
struct NewEdit {};

struct SetParameters {
  EditParameters parameters;
};

/// Makes the file follow the surface, starting with the open step. A file that an earlier step
/// carried continues from its current positions. A non-empty `file->save` replaces its save path.
struct CarryAlong {
  std::shared_ptr<const AttachmentFile> file;  ///< from `open_carried`
};

/// Stops carrying the file, starting with the open step. Removes the file from the state if no
/// earlier step carried it.
struct StopCarrying {
  std::filesystem::path file;
};

/// Adds a step that the caller has carried out on the visible surface (`apply_step`). If its result
/// is a mesh with new connectivity, the selection is cleared.
struct Apply {
  Step step;  ///< its file paths are absolute
  std::shared_ptr<const AppliedStep> result;
};

/// Replaces an earlier step. The caller has carried out the later steps again (`revised`).
struct Revise {
  Step step;  ///< the changed step
  std::shared_ptr<const AppState> result;
};

/// One action of a user, a test or a recipe.
using Command =
    std::variant<Choose, Paint, EnlargeRoi, Grab, SetFalloff, RemoveHandle, SetBeltWidth, SetMirror,
                 SetStiffness, MoveHandle, MoveHandles, Settle, Commit, NewEdit, SetParameters,
                 CarryAlong, StopCarrying, Apply, Revise>;

template <class... Kinds>
bool is_one_of(const Command& command) {
  return (std::holds_alternative<Kinds>(command) || ...);
}

/// Returns the state after `command`. Choose, Paint, RemoveHandle, NewEdit and Apply commit first,
/// so that regions are chosen on the visible surface. If the ROI changes, vertices outside it are
/// removed from the handles and from a belt that the user has chosen. EnlargeRoi and changes of
/// moves, falloffs, parameters, mirror, stiffness, belt width or carried files keep the rest shape
/// and discard the result. Throws the errors of `resolve`. Throws InputError if the state does not
/// allow the command, for example a choice while the result of a drag is not yet computed.
AppState apply(AppState state, const Command& command);

/// Returns the command's name for the history panel: "ROI: disk", "move handle 1", "settle".
std::string describe(const Command& command);

}  // namespace lapwing::viewer
