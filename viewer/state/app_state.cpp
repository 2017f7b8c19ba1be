#include "state/app_state.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/LU>

#include "lapwing/base/errors.h"
#include "lapwing/deform/handle_motion.h"
#include "lapwing/deform/modifiers/joined_request.h"
#include "lapwing/laplacian/rotation.h"

namespace lapwing::viewer {
namespace {

using Eigen::Affine3d;
using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector3d;

// Smaller differences are rounding errors.
constexpr double kSameMotion = 1e-9;

constexpr double kDegrees = 180.0 / std::numbers::pi;

// Returns the rotation R as an axis and an angle for a recipe. R determines the angle up to full
// turns; the result is the rotation nearest to `followed`.
AxisRotation written_turn(const Matrix3d& R, const AngleAxisd& followed) {
  constexpr double kWhole = 2.0 * std::numbers::pi;
  const AngleAxisd shortest(R);
  if (shortest.angle() < kSameMotion) {
    const double angle = kWhole * std::round(followed.angle() / kWhole);
    return angle == 0.0 ? AxisRotation{} : AxisRotation{followed.axis(), angle * kDegrees};
  }
  const double along = followed.angle() * followed.axis().dot(shortest.axis());
  const double angle = shortest.angle() + kWhole * std::round((along - shortest.angle()) / kWhole);
  return angle < 0.0 ? AxisRotation{-shortest.axis(), -angle * kDegrees}
                     : AxisRotation{shortest.axis(), angle * kDegrees};
}

// Returns the open step with its vertices on `surface_of(state)`. Lists the vertices of the ROI,
// because resolving the form of the ROI again could require computing geodesic distances.
DeformRequest step_on_surface(const AppState& state) {
  const JoinedSurface* joined = joined_seams(state);
  DeformRequest step =
      joined == nullptr ? open_step(state) : joined_request(open_step(state), *joined);
  step.roi.form = ListedVertices{state.selection.roi.vertices};
  return step;
}

// Calls `visit` for each handle of the DeformSolver. The arguments are its index, its move, and the
// index of its handle in the selection. `move_of` returns the move of a handle of the selection.
void each_move(const AppState& state, const auto& move_of, const auto& visit) {
  for (std::size_t h = 0; h < state.moves.size(); ++h) {
    const bool lies_across = state.mirrored && state.mirrored->handle_images[h] == h;
    if (lies_across) {
      visit(h, along_mirror(move_of(h), *state.selection.mirror), h);
    } else {
      visit(h, Move(move_of(h)), h);
    }
  }
  if (!state.mirrored) return;
  for (std::size_t image = state.moves.size(); image < state.mirrored->handle_images.size();
       ++image) {
    const std::size_t h = state.mirrored->handle_images[image];
    visit(image, mirror_image(move_of(h), *state.selection.mirror), h);
  }
}

Vector3d centroid_of(const AppState& state, std::size_t handle) {
  return state.mirrored ? state.mirrored->centroids[handle] : handle_centroid(state, handle);
}

}  // namespace

MovedVertices moved_vertices(const Positions& before, const Positions& after) {
  MovedVertices moved;
  for (Index v = 0; v < before.size(); ++v) {
    if (before[v] == after[v]) continue;
    moved.vertices.push_back(v);
    moved.positions.push_back(after[v]);
  }
  return moved;
}

void place(const MovedVertices& moved, Positions& positions) {
  for (std::size_t k = 0; k < moved.vertices.size(); ++k) {
    positions[moved.vertices[k]] = moved.positions[k];
  }
}

bool any_moved(std::span<const HandleMove> moves) {
  return !std::ranges::all_of(moves, &HandleMove::is_at_rest);
}

AppState open_state(Mesh mesh) {
  return open_state(std::make_shared<const Mesh>(std::move(mesh)));
}

AppState open_state(std::shared_ptr<const Mesh> mesh) {
  AppState state;
  set_rest(state, std::move(mesh));
  // Compute the topologies now, while the user waits for the file to open.
  state.rest->topology();
  surface_of(state)->topology();
  return state;
}

void set_rest(AppState& state, std::shared_ptr<const Mesh> rest) {
  const bool has_same_faces = state.rest && state.rest->shares_faces_with(*rest);
  state.rest = std::move(rest);
  const Positions& positions = state.rest->positions;
  const bool is_closed = has_same_faces && state.joined && state.joined->is_closed_at(positions);
  JoinedSurface joined = is_closed ? *state.joined : joined_surface(*state.rest);
  if (joined.empty()) {
    state.joined = nullptr;
    return;
  }
  joined.surface.positions = positions;
  state.joined = std::make_shared<const JoinedSurface>(std::move(joined));
}

const JoinedSurface* joined_seams(const AppState& state) {
  return state.parameters.seams == SeamPolicy::join ? state.joined.get() : nullptr;
}

std::shared_ptr<const Mesh> surface_of(const AppState& state) {
  if (joined_seams(state) == nullptr) return state.rest;
  return {state.joined, &state.joined->surface};
}

bool moves_as_a_whole(const AppState& state) {
  const EditSelection& selection = state.selection;
  const VertexSet& roi = selection.roi.vertices;
  if (selection.handles.size() != 1 || roi.empty() || !selection.belt.vertices.empty() ||
      selection.mirror) {
    return false;
  }
  return with_ring_neighbours(roi, surface_of(state)->topology().rings).size() == roi.size();
}

bool is_moved(const AppState& state) {
  return any_moved(state.moves);
}

bool needs_settling(const AppState& state) {
  return is_moved(state) && !state.settled;
}

Positions positions_of(const AppState& state) {
  Positions positions = state.rest->positions;
  if (state.settled) place(*state.settled, positions);
  return positions;
}

Mesh mesh_of(const AppState& state) {
  Mesh mesh = *state.rest;
  mesh.positions = positions_of(state);
  return mesh;
}

CarriedFiles carried_of(const AppState& state) {
  if (state.settled && !state.settled->carried.empty()) return state.settled->carried;
  CarriedFiles files;
  for (const CarriedObject& object : state.carried) files.push_back(object.rest);
  return files;
}

EditRegion edit_region(const AppState& state) {
  if (state.mirrored) return state.mirrored->region;
  const Mesh& surface = *surface_of(state);
  DeformRequest step = step_on_surface(state);
  if (state.selection.mirror) {
    return resolve_edit_region(mirrored_request(step, surface).request, surface);
  }
  // Like the ROI, the belt is listed, because it was already found when it was chosen.
  step.belt = RegionSpec{ListedVertices{state.selection.belt.vertices}, "belt"};
  EditRegion region = resolve_edit_region(step, surface);
  if (state.selection.belt_fraction) region.held_holes = state.selection.held_holes;
  return region;
}

void renew_mirror(AppState& state) {
  state.mirrored = nullptr;
  if (!state.selection.mirror) return;
  const Mesh& surface = *surface_of(state);
  try {
    MirroredRequest both = mirrored_request(step_on_surface(state), surface);
    MirroredEdit edit{
        resolve_edit_region(both.request, surface), std::move(both.handle_images), {}};
    for (const VertexSet& handle : edit.region.handles) {
      edit.centroids.push_back(handle_frame(handle, surface.positions).centroid);
    }
    state.mirrored = std::make_shared<const MirroredEdit>(std::move(edit));
  } catch (const InputError&) {
    // The edit is still incomplete. Preparation reports what is missing.
  }
}

Move shown_move(const AppState& state, std::size_t handle) {
  const HandleMove& to = state.moves[handle];
  if (to.orientation == HandleOrientation::kept || !state.settled) return to.move;
  // Fit a rotation to the handle's vertices, about the centre that its move prescribes.
  const Vector3d centroid = handle_centroid(state, handle);
  const Affine3d map = to_affine(to.move, centroid);
  const Vector3d centre = map * centroid;
  const MovedVertices& moved = *state.settled;
  Matrix3d covariance = Matrix3d::Zero();
  for (const Index v : state.selection.handles[handle].vertices) {
    const auto at = std::lower_bound(moved.vertices.begin(), moved.vertices.end(), v);
    const bool is_moved = at != moved.vertices.end() && *at == v;
    const auto k = static_cast<std::size_t>(at - moved.vertices.begin());
    const Vector3d place = is_moved ? moved.positions[k] : state.rest->positions[v];
    covariance += (place - centre) * (state.rest->positions[v] - centroid).transpose();
  }
  const Affine3d shown = turned_to(map, centroid, nearest_rotation(covariance));
  return to_move(shown, shortest_turn(shown), centroid);
}

HandleMotions motions_of(const AppState& state) {
  HandleMotions motions;
  bool any_free = false;
  const auto add = [&](std::size_t h, const Move& move, std::size_t of) {
    motions.maps.push_back(to_affine(move, centroid_of(state, h)));
    const AxisRotation turn = turn_of(move);
    motions.turns.emplace_back(turn.degrees * std::numbers::pi / 180.0, turn.axis);
    const bool is_free = state.moves[of].orientation == HandleOrientation::free;
    motions.is_free.push_back(is_free ? 1 : 0);
    any_free = any_free || is_free;
  };
  each_move(
      state, [&](std::size_t h) { return shown_move(state, h); }, add);
  if (!any_free) motions.is_free.clear();
  return motions;
}

std::vector<HandleMotions> path_of(const AppState& state) {
  std::vector<HandleMotions> path;
  if (state.moves.empty()) return path;
  AppState there = state;
  there.settled = nullptr;
  for (std::size_t k = 0; k < state.moves.front().path.size(); ++k) {
    for (std::size_t h = 0; h < state.moves.size(); ++h) {
      there.moves[h].move = state.moves[h].path[k];
    }
    path.push_back(motions_of(there));
  }
  return path;
}

void maps_of(const AppState& state, std::size_t handle, const Move& move,
             std::vector<Affine3d>& maps) {
  maps.clear();
  const auto move_of = [&](std::size_t h) -> const Move& {
    return h == handle ? move : state.moves[h].move;
  };
  each_move(state, move_of, [&](std::size_t h, const Move& of_handle, std::size_t) {
    maps.push_back(to_affine(of_handle, centroid_of(state, h)));
  });
}

void dragged_handles(const AppState& state, std::size_t handle, bool from_rest,
                     std::vector<std::size_t>& dragged) {
  dragged.clear();
  for (std::size_t h = 0; h < state.moves.size(); ++h) {
    const bool is_moved_already = from_rest && !state.moves[h].is_at_rest();
    if (h != handle && !is_moved_already) continue;
    dragged.push_back(h);
    if (!state.mirrored || state.mirrored->handle_images[h] == h) continue;
    dragged.push_back(state.mirrored->handle_images[h]);
  }
  std::sort(dragged.begin(), dragged.end());
}

Vector3d handle_centroid(const AppState& state, std::size_t handle) {
  if (state.mirrored) return state.mirrored->centroids[handle];
  const ChosenHandle& chosen = state.selection.handles[handle];
  // This function is called in every frame of a drag, so avoid a copy if all weights are 1.
  if (chosen.falloff.field.empty()) {
    return handle_frame(chosen.vertices, state.rest->positions).centroid;
  }
  return handle_frame(fully_held(chosen), state.rest->positions).centroid;
}

Move to_move(const Affine3d& motion, const AngleAxisd& turn, const Vector3d& centroid) {
  const Matrix3d A = motion.linear();
  const Matrix3d R = nearest_rotation(A);
  const Matrix3d stretch = R.transpose() * A;
  const Vector3d scale = stretch.diagonal();
  const Matrix3d off_axes = stretch - Matrix3d(scale.asDiagonal());
  const bool along_axes = scale.minCoeff() > 0.0 && off_axes.norm() < kSameMotion * scale.norm();
  if (!along_axes) return MatrixMove{motion.matrix().topRows<3>()};
  SimilarityMove move;
  move.translate = motion * centroid - centroid;
  move.rotate = written_turn(R, turn);
  const auto is_uniform = [&](double number) {
    return (scale.array() - number).abs().maxCoeff() <= kSameMotion * number;
  };
  if (is_uniform(scale.mean())) {
    if (!is_uniform(1.0)) move.scale.setConstant(scale.mean());
  } else {
    move.scale = scale;
  }
  return move;
}

DeformRequest open_step(const AppState& state) {
  DeformRequest step;
  step.roi = spec_of(state.selection.roi, "ROI");
  step.belt = belt_spec(state.selection);
  for (const auto& [spec, falloff] : handle_specs(state.selection)) {
    const HandleMove& to = state.moves[step.handles.size()];
    step.handles.push_back({spec, to.move, falloff, to.orientation, to.path});
  }
  step.parameters = state.parameters;
  step.stiffness = state.selection.stiffness;
  if (state.selection.mirror) step.mirror = MirrorSpec{*state.selection.mirror, "mirror"};
  step.carry = carry_specs(state.carried);
  return step;
}

}  // namespace lapwing::viewer
