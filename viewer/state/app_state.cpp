#include "state/app_state.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/LU>

#include "lapwing/deform/handle_motion.h"
#include "lapwing/laplacian/rotation.h"
#include "lapwing/region/joined_regions.h"

namespace lapwing::viewer {
namespace {

using Eigen::Affine3d;
using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector3d;

// A hand cannot mean less, and rounding leaves more.
constexpr double kSameMotion = 1e-9;

constexpr double kDegrees = 180.0 / std::numbers::pi;

// The rotation as a recipe writes it: of the turns that lead to R, which are whole turns apart, the
// one nearest to the turn followed.
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

AppState open_state(Mesh mesh) {
  return open_state(std::make_shared<const Mesh>(std::move(mesh)));
}

AppState open_state(std::shared_ptr<const Mesh> mesh) {
  AppState state;
  set_rest(state, std::move(mesh));
  // Here, where there is time for it.
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

bool is_moved(const AppState& state) {
  return std::any_of(state.moves.begin(), state.moves.end(),
                     [](const Move& move) { return move != Move(SimilarityMove{}); });
}

bool needs_settling(const AppState& state) {
  return is_moved(state) && !state.settled;
}

Positions positions_of(const AppState& state) {
  Positions positions = state.rest->positions;
  if (!state.settled) return positions;
  const MovedVertices& moved = *state.settled;
  for (std::size_t k = 0; k < moved.vertices.size(); ++k) {
    positions[moved.vertices[k]] = moved.positions[k];
  }
  return positions;
}

Mesh mesh_of(const AppState& state) {
  Mesh mesh = *state.rest;
  mesh.positions = positions_of(state);
  return mesh;
}

EditRegion edit_region(const AppState& state) {
  RegionSpec roi = spec_of(state.selection.roi, "ROI");
  BeltSpec belt = belt_spec(state.selection);
  std::vector<RegionSpec> handles = handle_specs(state.selection);
  if (const JoinedSurface* joined = joined_seams(state)) {
    roi = led(roi, *joined);
    belt = led(belt, *joined);
    for (RegionSpec& handle : handles) handle = led(handle, *joined);
  }
  return resolve_edit_region(roi, belt, handles, *surface_of(state), state.parameters.loose);
}

std::vector<Affine3d> motions_of(const AppState& state) {
  std::vector<Affine3d> motions;
  for (std::size_t h = 0; h < state.moves.size(); ++h) {
    motions.push_back(to_affine(state.moves[h], handle_centroid(state, h)));
  }
  return motions;
}

void motions_of(const AppState& state, std::size_t handle, const Move& move,
                std::vector<Affine3d>& motions) {
  motions.clear();
  for (std::size_t h = 0; h < state.moves.size(); ++h) {
    motions.push_back(to_affine(h == handle ? move : state.moves[h], handle_centroid(state, h)));
  }
}

std::vector<AngleAxisd> turns_of(const AppState& state) {
  std::vector<AngleAxisd> turns;
  for (const Move& move : state.moves) {
    const AxisRotation turn = turn_of(move);
    turns.emplace_back(turn.degrees * std::numbers::pi / 180.0, turn.axis);
  }
  return turns;
}

Vector3d handle_centroid(const AppState& state, std::size_t handle) {
  return handle_frame(state.selection.handles[handle].vertices, state.rest->positions).centroid;
}

Move to_move(const Affine3d& motion, const AngleAxisd& turn, const Vector3d& centroid) {
  const Matrix3d A = motion.linear();
  const Matrix3d R = nearest_rotation(A);
  const Matrix3d stretch = R.transpose() * A;
  const double scale = stretch.trace() / 3.0;
  const bool similar =
      scale > 0.0 && (stretch - scale * Matrix3d::Identity()).norm() < kSameMotion * scale;
  if (!similar) return MatrixMove{motion.matrix().topRows<3>()};
  SimilarityMove move;
  move.translate = motion * centroid - centroid;
  move.rotate = written_turn(R, turn);
  if (std::abs(scale - 1.0) > kSameMotion) move.scale = scale;
  return move;
}

DeformRequest open_step(const AppState& state) {
  DeformRequest step;
  step.roi = spec_of(state.selection.roi, "ROI");
  step.belt = belt_spec(state.selection);
  for (const RegionSpec& spec : handle_specs(state.selection)) {
    step.handles.push_back({spec, state.moves[step.handles.size()]});
  }
  step.parameters = state.parameters;
  return step;
}

}  // namespace lapwing::viewer
