#include "state/waypoints.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <Eigen/LU>

#include "lapwing/deform/modifiers/substeps.h"
#include "lapwing/deform/turn_tracker.h"

namespace lapwing::viewer {
namespace {

// If consecutive waypoints differ by at most 30 degrees and a tenth of the region's size, a run of
// the recipe finds the same minimum as the drag. A rotation by 360 degrees has twelve waypoints.
constexpr double kFarTurn = 30.0 * std::numbers::pi / 180.0;
constexpr double kFarWay = 0.1;
constexpr double kFarStretch = 0.25;
// If a handle rotates farther than this in one step, DeformSolver starts again from the rest shape.
constexpr double kJump = kFarTurnDegrees * std::numbers::pi / 180.0;

Eigen::Vector3d turn_vector(const Move& move) {
  const AxisRotation turn = turn_of(move);
  return turn.degrees * std::numbers::pi / 180.0 * turn.axis;
}

Eigen::Matrix3d stretch_of(const Eigen::Affine3d& map) {
  return shortest_turn(map).toRotationMatrix().transpose() * map.linear();
}

}  // namespace

double region_size(const AppState& state) {
  const VertexSet& roi = state.selection.roi.vertices;
  if (roi.empty()) return 0.0;
  Eigen::AlignedBox3d box;
  for (const Index v : roi) box.extend(state.rest->positions[v]);
  return box.diagonal().norm();
}

bool are_far_apart(const Move& from, const Move& to, const Eigen::Vector3d& handle_centroid,
                   double region_size) {
  if (from == to) return false;
  const Eigen::Affine3d before = to_affine(from, handle_centroid);
  const Eigen::Affine3d after = to_affine(to, handle_centroid);
  if ((after * handle_centroid - before * handle_centroid).norm() >= kFarWay * region_size) {
    return true;
  }
  return (turn_vector(to) - turn_vector(from)).norm() >= kFarTurn ||
         (stretch_of(after) - stretch_of(before)).norm() >= kFarStretch;
}

bool is_jump(const Move& from, const Move& to) {
  return (turn_vector(to) - turn_vector(from)).norm() > kJump;
}

bool uses_substeps(const EditParameters& parameters, std::span<const HandleMove> moves) {
  double degrees = 0.0;
  bool has_path = false;
  for (const HandleMove& to : moves) {
    if (to.orientation == HandleOrientation::kept) {
      degrees = std::max(degrees, turn_of(to.move).degrees);
    }
    has_path = has_path || !to.path.empty();
  }
  return substep_degrees(parameters, degrees, has_path).has_value();
}

WaypointRecorder::WaypointRecorder(Move start, const Eigen::Vector3d& handle_centroid,
                                   double region_size)
    : last_(start),
      last_far_(std::move(start)),
      centroid_(handle_centroid),
      region_size_(region_size) {
  // Reserve memory, so that the frames of a typical drag allocate none.
  constexpr std::size_t kUsual = 256;
  waypoints_.reserve(kUsual);
}

void WaypointRecorder::add(const Move& move) {
  has_jumped_ = has_jumped_ || is_jump(last_, move);
  last_ = move;
  if (!are_far_apart(last_far_, move, centroid_, region_size_)) return;
  last_far_ = move;
  waypoints_.push_back(move);
}

void extend_path(AppState& state, std::size_t handle, const HandleMove& to) {
  bool goes_on = !uses_substeps(state.parameters, state.moves);
  Move last = state.moves[handle].move;
  for (const Move& waypoint : to.path)
    goes_on = goes_on && !is_jump(std::exchange(last, waypoint), waypoint);
  const bool turns = to.orientation == HandleOrientation::kept;
  if (!goes_on || (turns && is_jump(last, to.move))) {
    for (HandleMove& each : state.moves) each.path.clear();
    return;
  }
  const double size = region_size(state);
  bool is_far = false;
  for (std::size_t h = 0; h < state.moves.size(); ++h) {
    const HandleMove& now = state.moves[h];
    const Move before = now.path.empty() ? Move(SimilarityMove{}) : now.path.back();
    is_far = is_far || are_far_apart(before, now.move, handle_centroid(state, h), size);
  }
  if (is_far) {
    for (HandleMove& now : state.moves) now.path.push_back(now.move);
  }
  for (const Move& waypoint : to.path) {
    for (std::size_t h = 0; h < state.moves.size(); ++h) {
      HandleMove& now = state.moves[h];
      now.path.push_back(h == handle ? waypoint : now.move);
    }
  }
}

}  // namespace lapwing::viewer
