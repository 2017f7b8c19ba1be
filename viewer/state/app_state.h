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

/// Stores the options of settling while settling is switched off.
class LastSolveOptions {
 public:
  /// Returns `after`. If `after` settles and `before` does not, the options are those that settling
  /// had before it was switched off.
  EditParameters meant(const EditParameters& before, EditParameters after) {
    if (before.settle) options_ = *before.settle;
    if (!before.settle && after.settle) after.settle = options_;
    return after;
  }

 private:
  SettleOptions options_;
};

/// The vertices that are moved by a result, and their new positions.
struct MovedVertices {
  std::vector<Index> vertices;  ///< ascending
  Positions positions;
  /// The moved files, in the order of AppState::carried. Empty if no file follows the surface.
  CarriedFiles carried = {};
  /// The certificate of a settled edit; ignored by ==.
  std::shared_ptr<const Certificate> certificate = {};

  bool operator==(const MovedVertices& other) const {
    return vertices == other.vertices && positions == other.positions && carried == other.carried;
  }
};

/// `before` and `after` are two poses of one mesh. Returns the vertices whose positions are not
/// bitwise identical, with their positions in `after`.
MovedVertices moved_vertices(const Positions& before, const Positions& after);
/// Writes the positions of the moved vertices to `positions`. Does not change other vertices.
void place(const MovedVertices& moved, Positions& positions);

/// The result of a whole step: the moved vertices, or a new mesh if the connectivity changed.
using AppliedStep = std::variant<MovedVertices, std::shared_ptr<const Mesh>>;

/// Describes how a handle moves, on which path, and whether its orientation is free.
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

/// A mirrored edit, with the selection on both sides of the mirror plane.
struct MirroredEdit {
  EditRegion region;                       ///< input of the DeformSolver
  std::vector<std::size_t> handle_images;  ///< as in MirroredRequest
  std::vector<Eigen::Vector3d> centroids;  ///< default pivots of the handles of `region`
};

/// Contains everything that a user edits. Copies share meshes and results through pointers, so
/// copying a state costs little more than copying its selection.
///
/// The user chooses parts on the mesh `rest` and moves the handles (`moves`). The deformed surface
/// is stored in `settled` once it is computed. When the user then chooses another part, the edit is
/// appended to `steps`, and the settled surface becomes the rest shape of the next edit. All other
/// operations are whole steps (`Apply`), which may change the connectivity.
struct AppState {
  std::shared_ptr<const Mesh> rest;
  std::shared_ptr<const JoinedSurface> joined;  ///< `rest` with joined seams; null without seams
  EditSelection selection;
  EditParameters parameters;
  std::vector<HandleMove> moves;       ///< one per handle, relative to the rest shape
  std::vector<CarriedObject> carried;  ///< carried by the open step or an earlier one
  /// The selection on both sides of the mirror plane, computed by `renew_mirror`. Null if mirroring
  /// is off or the edit is incomplete.
  std::shared_ptr<const MirroredEdit> mirrored;
  /// The result for `moves`. Null if no handle has moved or the result is not yet computed.
  std::shared_ptr<const MovedVertices> settled;
  /// The steps that lead from the opened mesh to `rest`. Their file paths are absolute.
  std::vector<std::shared_ptr<const Step>> steps;
};

/// Returns the state of a newly opened mesh, with an empty selection. Throws the errors of
/// `Mesh::topology`.
AppState open_state(Mesh mesh);
AppState open_state(std::shared_ptr<const Mesh> mesh);

/// Sets the rest shape and joins its seams. If the faces are those of the previous rest shape and
/// the previous seams are still closed, the same vertices as in the previous rest shape are joined.
void set_rest(AppState& state, std::shared_ptr<const Mesh> rest);

/// Returns `state.joined`, or null if the parameters leave the seams open.
const JoinedSurface* joined_seams(const AppState& state);
/// Returns the mesh that the user sees and edits: the rest shape, with joined seams if
/// `joined_seams(state)` is not null. Joining does not renumber the vertices. A vertex that is
/// joined to another vertex belongs to no triangle.
std::shared_ptr<const Mesh> surface_of(const AppState& state);

/// Computes `mirrored` from the selection. Takes up to a second.
void renew_mirror(AppState& state);

/// Returns true if nothing holds the surface against its only handle: no neighbours outside the
/// ROI, no belt and no mirror image of the handle. The surface then moves as a whole.
bool moves_as_a_whole(const AppState& state);
/// Returns whether a handle has moved from its rest position.
bool is_moved(const AppState& state);
/// Returns whether a handle has moved and the result is not computed yet.
bool needs_settling(const AppState& state);

/// Returns the vertex positions of the settled surface, or of the rest shape without a result.
Positions positions_of(const AppState& state);
Mesh mesh_of(const AppState& state);
/// Returns the carried files on the surface of `mesh_of`, in the order of AppState::carried.
CarriedFiles carried_of(const AppState& state);

/// Returns ROI, belt and handles for the DeformSolver. Throws InputError if the selection is
/// incomplete or invalid; the message names the missing part.
EditRegion edit_region(const AppState& state);

/// Returns the motions for `DeformSolver::solve`. If mirroring is on, they include the handles on
/// both sides of the plane. If the orientation of a handle is free and the state has a result, the
/// handle's rotation is taken from the result.
HandleMotions motions_of(const AppState& state);
/// Returns the motions at the waypoints of the moves, for `DeformSolver::solve_along`.
std::vector<HandleMotions> path_of(const AppState& state);
/// Writes the motions of all handles for a frame of a drag to `maps`; `handle` is moved by `move`.
/// Does not allocate memory if `maps` already has the capacity for all handles.
void maps_of(const AppState& state, std::size_t handle, const Move& move,
             std::vector<Eigen::Affine3d>& maps);
/// Returns the handle's move. If the orientation of the handle is free and the state has a result,
/// the rotation is taken from the result.
Move shown_move(const AppState& state, std::size_t handle);
/// Writes the indices of the handles that move while `handle` is dragged to `dragged`, in ascending
/// order: `handle` and, with mirroring, its image. If frames start `from_rest`, adds all handles
/// that moved earlier, with their images. Allocates memory only if `dragged` must grow.
void dragged_handles(const AppState& state, std::size_t handle, bool from_rest,
                     std::vector<std::size_t>& dragged);
/// Returns the centroid at rest of the vertices that the handle holds with full weight. It is the
/// default pivot of a move.
Eigen::Vector3d handle_centroid(const AppState& state, std::size_t handle);

/// Converts a motion to a move. `turn` is its accumulated rotation, which may exceed 180 degrees.
/// Returns a SimilarityMove with all full turns if one equals the motion up to rounding errors,
/// otherwise a MatrixMove.
Move to_move(const Eigen::Affine3d& motion, const Eigen::AngleAxisd& turn,
             const Eigen::Vector3d& centroid);

/// Returns the open edit as a step. A part that is not selected yet is an empty vertex list.
DeformRequest open_step(const AppState& state);

}  // namespace lapwing::viewer
