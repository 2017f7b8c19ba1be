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

/// Replaces the part by a region.
struct Choose {
  Part part;
  RegionSpec region;
  std::optional<Falloff> falloff = {};  ///< of a handle; if not set, it keeps its falloff
};

/// Adds and removes vertices of the part: a stroke of the brush, a lasso, grow, shrink, invert.
struct Paint {
  Part part;
  VertexSet added;
  VertexSet removed;
};

/// Begins another edit with this region and one handle.
struct Grab {
  RegionSpec roi;
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

/// Sets the belt by its width, as a fraction of the ROI's radius, instead of by hand.
struct SetBeltWidth {
  double fraction = BoundaryAnchors{}.fraction;
};

/// Turns mirroring on for the plane, or off without one.
struct SetMirror {
  std::optional<MirrorPlane> plane;
};

/// Sets the handle's move from its rest position. `to.path` contains the waypoints since the
/// handle's last move. `extend_path` extends the path in the state by them.
struct MoveHandle {
  std::size_t handle = 0;
  HandleMove to;
};

/// Moves all handles from their rest positions, along these paths instead of the earlier ones.
struct MoveHandles {
  std::vector<HandleMove> to;  ///< one per handle
};

/// Sets the result of the moves, which is computed elsewhere.
struct Settle {
  std::shared_ptr<const MovedVertices> result;
};

/// Makes the result the rest shape of the next edit.
struct Commit {};

/// The same, and clears the selection: another edit begins, with the same parameters, mirror and
/// width of the belt.
struct NewEdit {};

struct SetParameters {
  EditParameters parameters;
};

/// Lets the file follow the surface from the open step on. A file that was carried before goes on
/// from where it is. A `save` that is not empty replaces its earlier one.
struct CarryAlong {
  std::shared_ptr<const AttachmentFile> file;  ///< open_carried
};

/// Leaves the file where it is from the open step on. Removes it if no earlier step carried it.
struct StopCarrying {
  std::filesystem::path file;
};

/// Adds a step that was carried out elsewhere, on the visible surface (`apply_step`). If its result
/// has other triangles, the selection is cleared.
struct Apply {
  Step step;  ///< naming files by absolute paths
  std::shared_ptr<const AppliedStep> result;
};

/// Replaces an earlier step. The steps after it were carried out again elsewhere (`revised`).
struct Revise {
  Step step;  ///< the changed step
  std::shared_ptr<const AppState> result;
};

/// One action of a user, a test or a recipe.
using Command = std::variant<Choose, Paint, Grab, SetFalloff, RemoveHandle, SetBeltWidth, SetMirror,
                             MoveHandle, MoveHandles, Settle, Commit, NewEdit, SetParameters,
                             CarryAlong, StopCarrying, Apply, Revise>;

template <class... Kinds>
bool is_one_of(const Command& command) {
  return (std::holds_alternative<Kinds>(command) || ...);
}

/// Returns the state after `command`. Commands that choose, paint or apply first make the settled
/// surface the rest shape, so that parts are chosen on the visible surface. If the ROI changes,
/// vertices outside it are removed from the handles and from a belt that the user has chosen. If
/// moves, parameters, the belt's width or carried files change, the rest shape stays and a new
/// result is needed. Throws what `resolve` throws. Throws InputError if the state does not allow
/// the command, for example a choice while the result of a drag is not yet computed.
AppState apply(AppState state, const Command& command);

/// Returns the command's name in the history panel: "ROI: disk", "move handle 1", "settle".
std::string describe(const Command& command);

}  // namespace lapwing::viewer
