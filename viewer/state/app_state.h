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

/// `before` and `after` are two poses of one mesh. Returns the vertices whose positions are not
/// bitwise identical, with their positions in `after`.
MovedVertices moved_vertices(const Positions& before, const Positions& after);
/// Writes the positions of the moved vertices to `positions`. Does not change other vertices.
void place(const MovedVertices& moved, Positions& positions);

/// Holds the result of a whole step: the moved vertices, or a new mesh if the connectivity changed.
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

/// An edit with a mirror, on both sides of the plane.
struct MirroredEdit {
  EditRegion region;                       ///< for the DeformSolver
  std::vector<std::size_t> handle_images;  ///< as in MirroredRequest
  std::vector<Eigen::Vector3d> centroids;  ///< of the region's handles, which turn about them
};

/// Holds everything that a user edits. Copies share meshes and results through pointers, so copying
/// a state costs little more than copying its selection.
///
/// The user chooses parts on the mesh `rest` and moves the handles (`moves`). The deformed surface
/// is stored in `settled` once it is computed. When the user then chooses another part, the edit is
/// appended to `steps`, and the settled surface becomes the rest shape of the next edit. All other
/// operations are whole steps (`Apply`), which may change the connectivity.
struct AppState {
  std::shared_ptr<const Mesh> rest;
  std::shared_ptr<const JoinedSurface> joined;  ///< of `rest`; null if it has no seam
  EditSelection selection;
  EditParameters parameters;
  std::vector<HandleMove> moves;       ///< one per handle, from the rest shape
  std::vector<CarriedObject> carried;  ///< carried by the open step or an earlier one
  /// The selection on both sides of the mirror plane, computed by `renew_mirror`. Null if mirroring
  /// is off or the edit is incomplete.
  std::shared_ptr<const MirroredEdit> mirrored;
  /// The result for `moves`. Null if no handle has moved or the result is not yet computed.
  std::shared_ptr<const MovedVertices> settled;
  /// The steps from the opened mesh to `rest`. They name files by absolute paths.
  std::vector<std::shared_ptr<const Step>> steps;
};

/// Returns the state of a mesh as it was read, with nothing chosen. Throws what `Mesh::topology`
/// throws.
AppState open_state(Mesh mesh);
AppState open_state(std::shared_ptr<const Mesh> mesh);

/// Sets the rest shape and joins its seams. If the faces are those of the previous rest shape and
/// the previous seams are still closed, joins the same vertices as before.
void set_rest(AppState& state, std::shared_ptr<const Mesh> rest);

/// Returns null if the parameters do not join seams, or if there are none.
const JoinedSurface* joined_seams(const AppState& state);
/// Returns the mesh that the user sees and edits: the rest shape, with its seams joined if the
/// parameters say so. Joining does not renumber the vertices. A vertex that is joined to another
/// one belongs to no triangle.
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

/// Returns the motions for `DeformSolver::solve`. If mirroring is on, they include the handles on
/// both sides of the plane. If the orientation of a handle is free and the state has a result, the
/// handle's rotation is taken from the result.
HandleMotions motions_of(const AppState& state);
/// Returns the path to these motions, for `DeformSolver::solve_along`.
std::vector<HandleMotions> path_of(const AppState& state);
/// Writes the motions for a frame of a drag to `maps`, with `handle` moved by `move`. Does not
/// allocate memory if `maps` already has the capacity for all handles.
void maps_of(const AppState& state, std::size_t handle, const Move& move,
             std::vector<Eigen::Affine3d>& maps);
/// Returns the move that the handle has made on the surface of `positions_of`. If the orientation
/// of the handle is free and the state has a result, the rotation is taken from the result.
Move shown_move(const AppState& state, std::size_t handle);
/// Writes to `dragged`, in ascending order, the handles that move in each frame while `handle` is
/// dragged: the handle itself and, with mirroring, its image. If frames start `from_rest`, also
/// adds all handles that were moved earlier, with their images. Allocates memory only if `dragged`
/// must grow.
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
