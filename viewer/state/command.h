#pragma once

#include <memory>
#include <string>
#include <variant>

#include "state/app_state.h"

namespace lapwing::viewer {

/// Which part of the selection a command is about.
struct Part {
  enum class Role { roi, handle, belt };
  Role role = Role::roi;
  std::size_t handle = 0;  ///< which one, from 0; their number stands for a new one

  bool operator==(const Part&) const = default;
};

/// The part is chosen anew.
struct Choose {
  Part part;
  RegionSpec region;
  std::optional<Grading> grading = {};  ///< of a handle; without it a handle keeps its own
};

/// The part gains and loses vertices: a stroke of the brush, a lasso, grow, shrink, invert.
struct Paint {
  Part part;
  VertexSet added;
  VertexSet removed;
};

/// How firmly the handle holds.
struct SetGrading {
  std::size_t handle = 0;
  Grading grading;
};

struct RemoveHandle {
  std::size_t handle = 0;
};

/// The belt goes by its width, a fraction of the ROI's radius, again.
struct SetBeltWidth {
  double fraction = BorderBelt{}.fraction;
};

/// All that is chosen is meant on both sides of the plane, or no longer.
struct SetMirror {
  std::optional<MirrorPlane> plane;
};

/// The handle is moved from its rest position; `to_move` makes a move of a motion and a turn. The
/// surface goes on from where it is: the path of `to` is what the handle went through since its
/// last move, and is added to the state's, with that move if it is far from the waypoint before.
struct MoveHandle {
  std::size_t handle = 0;
  HandleMove to;
};

/// All handles are moved from their rest positions along these paths, and by none before.
struct MoveHandles {
  std::vector<HandleMove> to;  ///< one per handle
};

/// The result of the moves, computed elsewhere.
struct Settle {
  std::shared_ptr<const MovedVertices> result;
};

/// The result becomes the rest shape of the next edit.
struct Commit {};

/// The same, and nothing is chosen any more: another edit begins, with the same parameters, mirror
/// and width of the belt.
struct NewEdit {};

struct SetParameters {
  EditParameters parameters;
};

/// The file follows the surface from the open step on. One that is there already, and stayed, goes
/// on from where it is; `save` of the file counts either way.
struct CarryAlong {
  std::shared_ptr<const CarriedFile> file;  ///< open_carried
};

/// The file stays where it is from the open step on; without an earlier step that took it along it
/// goes.
struct StopCarrying {
  std::filesystem::path file;
};

/// A step that was carried out elsewhere, on the surface that is seen (`apply_step`). Where its
/// result has other triangles nothing is chosen any more.
struct Apply {
  Step step;  ///< naming files by absolute paths
  std::shared_ptr<const AppliedStep> result;
};

/// An earlier step was taken up again and changed, and what follows it was carried out anew
/// elsewhere (`revised`).
struct Revise {
  Step step;  ///< as it is now
  std::shared_ptr<const AppState> result;
};

/// One thing that a person, a test or a recipe does.
using Command = std::variant<Choose, Paint, SetGrading, RemoveHandle, SetBeltWidth, SetMirror,
                             MoveHandle, MoveHandles, Settle, Commit, NewEdit, SetParameters,
                             CarryAlong, StopCarrying, Apply, Revise>;

/// The state after `command`. Choosing, painting and applying commit what is settled first: what is
/// chosen then is chosen on the surface that is seen. What an ROI that becomes another one does not
/// hold of handles, and of a belt chosen by hand, is let go. Moves, parameters, the belt's width
/// and what is carried ask for a new result from the same rest shape. Throws InputError when the
/// state does not fit: a handle or carried file that does not exist, a result that nothing asked
/// for or that is of another mesh, a choice, step or commit while a drag waits for its result; and
/// what `resolve` throws. Pure.
AppState apply(AppState state, const Command& command);

/// What the history panel calls it: "ROI: disk", "move handle 1", "settle".
std::string describe(const Command& command);

}  // namespace lapwing::viewer
