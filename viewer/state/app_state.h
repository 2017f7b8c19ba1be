#pragma once

#include <memory>
#include <utility>
#include <variant>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/deform/certificate.h"
#include "lapwing/deform/handle_motion.h"
#include "lapwing/deform/move.h"
#include "lapwing/mesh/joined_surface.h"
#include "lapwing/recipe/recipe.h"
#include "lapwing/region/edit_region.h"
#include "state/carried_object.h"
#include "state/edit_selection.h"
#include "state/mirrored_edit.h"

namespace lapwing::viewer {

/// How the next edit is computed.
using EditParameters = DeformParameters;

/// Vertices that a result puts elsewhere, and where.
struct MovedVertices {
  std::vector<Index> vertices;  ///< ascending
  Positions positions;
  /// Where it puts AppState::carried, in that order; none where none of them follows.
  CarriedFiles carried = {};
  /// Of an edit that was settled; no part of the value.
  std::shared_ptr<const Certificate> certificate = {};

  bool operator==(const MovedVertices& other) const {
    return vertices == other.vertices && positions == other.positions && carried == other.carried;
  }
};

/// The vertices whose bits differ between `before` and `after`, of one mesh, where `after` puts
/// them.
MovedVertices moved_vertices(const Positions& before, const Positions& after);

/// What a step that is carried out as a whole comes to: the mesh with vertices elsewhere, or one
/// with other triangles in its place.
using AppliedStep = std::variant<MovedVertices, std::shared_ptr<const Mesh>>;

/// How a handle moves, by which way it came there, and whether it turns as the surface wants.
struct HandleMove {
  Move move;
  HandleOrientation orientation = HandleOrientation::kept;
  /// Moves that it went through before; those at one place in the paths of all handles belong
  /// together, and all paths are equally long.
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

/// All that a person edits, as a value. What is large is shared and never changed in place, so a
/// copy costs the selection.
///
/// One edit after the other: parts are chosen on the mesh `rest`, the handles are moved (`moves`),
/// the result is computed elsewhere and comes in as `settled`. It becomes the rest shape of the
/// next edit, and a step of `steps`, when something else is chosen. Other operations are steps as
/// a whole (`Apply`); those may change the triangles.
struct AppState {
  std::shared_ptr<const Mesh> rest;
  std::shared_ptr<const JoinedSurface> joined;  ///< of `rest`; null where that has no seam
  EditSelection selection;
  EditParameters parameters;
  std::vector<HandleMove> moves;       ///< one per handle, from the rest shape
  std::vector<CarriedObject> carried;  ///< by the open step or an earlier one
  /// With a mirror, what is chosen comes to on both sides; null without one, and while something is
  /// missing (`renew_mirror`).
  std::shared_ptr<const MirroredEdit> mirrored;
  /// The result of `moves`; null while nothing moved, and until it is computed.
  std::shared_ptr<const MovedVertices> settled;
  /// What made `rest` of the mesh opened; files are named by absolute paths.
  std::vector<std::shared_ptr<const Step>> steps;
};

/// A mesh as it was read, nothing chosen. Throws what `Mesh::topology` does.
AppState open_state(Mesh mesh);
AppState open_state(std::shared_ptr<const Mesh> mesh);

/// Makes `rest` the rest shape, and joins its seams: as they were, where the faces are and they
/// have not opened.
void set_rest(AppState& state, std::shared_ptr<const Mesh> rest);

/// Null where the seams are left as they are, or there is none.
const JoinedSurface* joined_seams(const AppState& state);
/// What is shown, chosen on and edited: the rest shape, with its seams joined as the parameters
/// say. Vertices have the same numbers and places; followers are in none of its triangles, and are
/// not chosen.
std::shared_ptr<const Mesh> surface_of(const AppState& state);

/// Makes `mirrored` what the selection comes to. A second or less.
void renew_mirror(AppState& state);

/// Whether a handle is somewhere else than at rest.
bool is_moved(const AppState& state);
/// Whether a handle is, and no result says yet where that takes the surface.
bool needs_settling(const AppState& state);

/// The surface as it is known: settled, or else at rest.
Positions positions_of(const AppState& state);
Mesh mesh_of(const AppState& state);
/// And what is carried along with it, in the order of AppState::carried.
CarriedFiles carried_of(const AppState& state);

/// ROI, belt and handles, checked: what the DeformSolver is prepared with. Throws InputError, in
/// words that say what is still missing.
EditRegion edit_region(const AppState& state);

/// What `DeformSolver::solve` takes: those of the recipe bit for bit; with a mirror, those of the
/// handles of both sides. A handle whose orientation is free has the rotation that the result gave
/// it.
HandleMotions motions_of(const AppState& state);
/// The path that leads there, for `DeformSolver::solve_along`.
std::vector<HandleMotions> path_of(const AppState& state);
/// For a frame of a drag: `maps` becomes those motions but for `handle`, which is moved by `move`.
/// Allocates nothing once `maps` is as long as there are handles. Linear in their vertices.
void maps_of(const AppState& state, std::size_t handle, const Move& move,
             std::vector<Eigen::Affine3d>& maps);
/// Where the handle is on the surface as it is known. Differs from its move if its orientation is
/// free.
Move shown_move(const AppState& state, std::size_t handle);
/// The handles that a frame moves in which `handle` is dragged, ascending: with `from_rest`, the
/// rest shape being where it moves them from, those that are moved already, too. Allocates nothing
/// once `dragged` has had as many.
void dragged_handles(const AppState& state, std::size_t handle, bool from_rest,
                     std::vector<std::size_t>& dragged);
/// Of the handle's vertices at rest, about which a move without pivot turns.
Eigen::Vector3d handle_centroid(const AppState& state, std::size_t handle);

/// The motion and the turn by which it came about as a move: a similarity where it is one to
/// rounding, and then with its whole turns; else a matrix.
Move to_move(const Eigen::Affine3d& motion, const Eigen::AngleAxisd& turn,
             const Eigen::Vector3d& centroid);

/// The edit in the making as a step. What is not chosen yet is an empty list.
DeformRequest open_step(const AppState& state);

}  // namespace lapwing::viewer
