#pragma once

#include <memory>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/deform/certificate.h"
#include "lapwing/deform/handle_motion.h"
#include "lapwing/deform/modifiers/mirrored_request.h"
#include "lapwing/deform/move.h"
#include "lapwing/mesh/seams.h"
#include "lapwing/recipe/recipe.h"
#include "lapwing/region/edit_region.h"
#include "state/carried_object.h"
#include "state/edit_selection.h"

namespace lapwing::viewer {

/// Parameters of the next edit.
using EditParameters = DeformParameters;

/// Remembers the options of settling while it is switched off.
class LastSolveOptions {
 public:
  /// Returns what a user means by changing `before` to `after`: settling that is switched on again
  /// keeps its options.
  EditParameters meant(const EditParameters& before, EditParameters after) {
    if (before.settle) options_ = *before.settle;
    if (!before.settle && after.settle) after.settle = options_;
    return after;
  }

 private:
  SettleOptions options_;
};

/// The vertices that a result moves, and their new positions.
struct MovedVertices {
  std::vector<Index> vertices;  ///< ascending
  Positions positions;
  /// New files for AppState::carried, in that order; empty if none of them follows.
  CarriedFiles carried = {};
  /// The certificate of a settled edit; ignored by ==.
  std::shared_ptr<const Certificate> certificate = {};

  bool operator==(const MovedVertices& other) const {
    return vertices == other.vertices && positions == other.positions && carried == other.carried;
  }
};

/// Returns the vertices whose bits differ between `before` and `after`, two poses of one mesh, with
/// their positions in `after`.
MovedVertices moved_vertices(const Positions& before, const Positions& after);
/// Copies the positions of the moved vertices to `positions`. Leaves the other vertices in place.
void place(const MovedVertices& moved, Positions& positions);

/// The result of a whole step: moved vertices, or a mesh with other triangles.
using AppliedStep = std::variant<MovedVertices, std::shared_ptr<const Mesh>>;

/// How a handle moves, the path to that move, and whether its orientation is free.
struct HandleMove {
  Move move;
  HandleOrientation orientation = HandleOrientation::kept;
  /// The waypoints before `move`. All handles have paths of the same length, and waypoints with the
  /// same index belong together.
  std::vector<Move> path = {};

  HandleMove() = default;
  HandleMove(Move to) : move(std::move(to)) {}
  HandleMove(SimilarityMove to) : move(std::move(to)) {}
  HandleMove(MatrixMove to) : move(std::move(to)) {}
  HandleMove(Move to, HandleOrientation turning, std::vector<Move> by)
      : move(std::move(to)), orientation(turning), path(std::move(by)) {}

  bool operator==(const HandleMove&) const = default;
  bool is_at_rest() const { return move == Move(SimilarityMove{}); }
};
bool any_moved(std::span<const HandleMove> moves);

/// An edit with a mirror, on both sides of the plane.
struct MirroredEdit {
  EditRegion region;                       ///< for the DeformSolver
  std::vector<std::size_t> handle_images;  ///< as in MirroredRequest
  std::vector<Eigen::Vector3d> centroids;  ///< of the region's handles, which turn about them
};

/// Everything that a user edits, as a value. Copies share large data, so copying a state costs as
/// much as copying its selection.
///
/// The user chooses parts on the mesh `rest` and moves the handles (`moves`). The result arrives as
/// `settled`. When the user chooses another part, the settled surface becomes the rest shape of the
/// next edit. The edit becomes one of the `steps`. Other operations are whole steps (`Apply`),
/// which may change the triangles.
struct AppState {
  std::shared_ptr<const Mesh> rest;
  std::shared_ptr<const JoinedSurface> joined;  ///< of `rest`; null if it has no seam
  EditSelection selection;
  EditParameters parameters;
  std::vector<HandleMove> moves;       ///< one per handle, from the rest shape
  std::vector<CarriedObject> carried;  ///< carried by the open step or an earlier one
  /// The selection on both sides of the mirror (`renew_mirror`). Null if mirroring is off or the
  /// edit is incomplete.
  std::shared_ptr<const MirroredEdit> mirrored;
  /// The result of `moves`. Null while nothing is moved, and until it is computed.
  std::shared_ptr<const MovedVertices> settled;
  /// The steps from the opened mesh to `rest`. They name files by absolute paths.
  std::vector<std::shared_ptr<const Step>> steps;
};

/// Returns the state of a mesh as it was read, with nothing chosen. Throws what `Mesh::topology`
/// throws.
AppState open_state(Mesh mesh);
AppState open_state(std::shared_ptr<const Mesh> mesh);

/// Sets the rest shape and joins its seams. Joins the same vertices as before if the faces are the
/// same and the seams are still closed.
void set_rest(AppState& state, std::shared_ptr<const Mesh> rest);

/// Returns null if seams are left as they are, or if there is none.
const JoinedSurface* joined_seams(const AppState& state);
/// Returns what is shown, chosen on and edited: the rest shape, with its seams joined if the
/// parameters say so. Joining keeps the numbers of the vertices. A vertex that follows another one
/// is in no triangle.
std::shared_ptr<const Mesh> surface_of(const AppState& state);

/// Computes `mirrored` from the selection. Takes up to a second.
void renew_mirror(AppState& state);

/// Returns whether a handle is moved from rest.
bool is_moved(const AppState& state);
/// Returns whether a handle is moved and the result is not known yet.
bool needs_settling(const AppState& state);

/// Returns the surface: settled if there is a result, else at rest.
Positions positions_of(const AppState& state);
Mesh mesh_of(const AppState& state);
/// Returns the carried files on that surface, in the order of AppState::carried.
CarriedFiles carried_of(const AppState& state);

/// Returns ROI, belt and handles, checked, for the DeformSolver. Throws InputError, which says what
/// is still missing.
EditRegion edit_region(const AppState& state);

/// Returns the motions for `DeformSolver::solve`. If mirroring is on, they include the handles of
/// both sides. A handle with free orientation has the rotation of the result.
HandleMotions motions_of(const AppState& state);
/// Returns the path to these motions, for `DeformSolver::solve_along`.
std::vector<HandleMotions> path_of(const AppState& state);
/// Sets `maps` to these motions for a frame of a drag, with `handle` moved by `move`. Allocates
/// nothing once `maps` has one entry per handle.
void maps_of(const AppState& state, std::size_t handle, const Move& move,
             std::vector<Eigen::Affine3d>& maps);
/// Returns the handle's move on the surface of `positions_of`. If the orientation of the handle is
/// free, the move has the rotation of the result.
Move shown_move(const AppState& state, std::size_t handle);
/// Sets `dragged` to the handles that a frame moves while `handle` is dragged, in ascending order.
/// If frames start `from_rest`, this includes handles that have already been moved. Allocates only
/// if `dragged` must grow.
void dragged_handles(const AppState& state, std::size_t handle, bool from_rest,
                     std::vector<std::size_t>& dragged);
/// Returns the centroid of the handle's vertices at rest. A move without a pivot turns about it.
Eigen::Vector3d handle_centroid(const AppState& state, std::size_t handle);

/// Converts a motion, reached by `turn`, to a move: a similarity with its whole turns if it is one
/// up to rounding, else a matrix.
Move to_move(const Eigen::Affine3d& motion, const Eigen::AngleAxisd& turn,
             const Eigen::Vector3d& centroid);

/// Returns the open edit as a step. Parts that are not chosen yet are empty lists.
DeformRequest open_step(const AppState& state);

}  // namespace lapwing::viewer
