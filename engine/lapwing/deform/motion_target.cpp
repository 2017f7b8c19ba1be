#include "lapwing/deform/motion_target.h"

#include <algorithm>
#include <numbers>
#include <utility>

#include "lapwing/base/errors.h"
#include "lapwing/deform/linear_response.h"
#include "lapwing/deform/turn_tracker.h"
#include "lapwing/laplacian/rotation.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

// `turn` is the axis times the angle in radians.
bool is_far(const Vector3d& turn) {
  return turn.norm() > kFarTurnDegrees * std::numbers::pi / 180.0;
}

Vector3d vector_of(const Eigen::AngleAxisd& turn) {
  return turn.angle() * turn.axis();
}

FreeHandle free_handle(const EditSystem& edit, std::size_t handle, const Eigen::Affine3d& map) {
  const Vector3d& centroid = edit.frames[handle].centroid;
  const Vector3d centre = map * centroid;
  const Eigen::Matrix3d stretch = nearest_rotation(map.linear()).transpose() * map.linear();
  FreeHandle free;
  const auto add = [&](Index v) {
    if (edit.constraints.unknowns.of_vertex[v] == kNoIndex) return;
    free.vertices.push_back(v);
    free.shape.push_back(stretch * ((*edit.rest)[v] - centroid));
    free.to_centre.push_back(centre - (*edit.rest)[v]);
  };
  for (const Index v : edit.region.handles[handle]) add(v);
  for (const FalloffVertex& graded : edit.region.graded) {
    if (graded.handle == handle) add(graded.vertex);
  }
  return free;
}

}  // namespace

MotionTarget motion_target(const EditSystem& edit, HandleMotions motions,
                           std::vector<Vector3d> prescribed) {
  MotionTarget target;
  target.parameters.resize(edit.column_count());
  edit.set_parameters(motions.maps, target.parameters);
  if (motions.any_free() && (!edit.options.settle || edit.options.hard)) {
    throw InputError(
        "a handle with free orientation requires settling with soft constraints; keep its "
        "orientation, or remove \"hard\" and \"settle\": false");
  }
  target.prescribed = edit.prescribed_displacement(target.parameters, std::move(prescribed));
  if (edit.takes_rest_stretch()) target.stretch = rest_stretch(edit, motions.maps);
  for (std::size_t h = 0; h < motions.maps.size(); ++h) {
    if (!motions.is_free_handle(h)) continue;
    target.free_handles.push_back(free_handle(edit, h, motions.maps[h]));
  }
  target.motions = std::move(motions);
  return target;
}

void set_free_rotations(const EditSystem& edit, std::span<const Eigen::Matrix3d> rotations,
                        MotionTarget& target) {
  if (rotations.empty()) return;
  HandleMotions& motions = target.motions;
  std::size_t next = 0;
  for (std::size_t h = 0; h < motions.maps.size(); ++h) {
    if (!motions.is_free_handle(h)) continue;
    motions.maps[h] = turned_to(motions.maps[h], edit.frames[h].centroid, rotations[next++]);
    TurnTracker tracker(motions.turns[h]);
    tracker.follow(motions.maps[h]);
    motions.turns[h] = tracker.turn();
  }
  edit.set_parameters(motions.maps, target.parameters);
  target.prescribed = edit.prescribed_displacement(target.parameters, std::move(target.prescribed));
}

HandleMotions turned_as(HandleMotions motions, const HandleMotions& pose, const EditSystem& edit) {
  for (std::size_t h = 0; h < motions.maps.size() && h < pose.maps.size(); ++h) {
    if (!motions.is_free_handle(h)) continue;
    const Vector3d& centroid = edit.frames[h].centroid;
    const Eigen::Affine3d turned =
        turned_to(motions.maps[h], centroid, nearest_rotation(pose.maps[h].linear()));
    // If a handle has not moved, returns exactly its old map, although the new map has different
    // rounding errors.
    constexpr double kRounding = 1e-12;
    const Vector3d place = turned * centroid;
    const double size = place.norm() + centroid.norm() + edit.frames[h].radius;
    const bool is_same =
        (place - pose.maps[h] * centroid).norm() <= kRounding * size &&
        (turned.linear() - pose.maps[h].linear()).norm() <= kRounding * turned.linear().norm();
    motions.maps[h] = is_same ? pose.maps[h] : turned;
    motions.turns[h] = pose.turns[h];
  }
  return motions;
}

bool any_turned_far(std::span<const Eigen::AngleAxisd> turns) {
  return std::any_of(turns.begin(), turns.end(),
                     [](const Eigen::AngleAxisd& turn) { return is_far(vector_of(turn)); });
}

bool any_turned_far_since(const HandleMotions& last, const HandleMotions& now) {
  for (std::size_t h = 0; h < last.turns.size() && h < now.turns.size(); ++h) {
    if (now.is_free_handle(h)) continue;
    if (is_far(vector_of(now.turns[h]) - vector_of(last.turns[h]))) return true;
  }
  return false;
}

std::vector<Vector3d> start_by_handle_weights(const EditSystem& edit, const HandleWeights& weights,
                                              const MotionTarget& target) {
  const HandleMotions& motions = target.motions;
  std::vector<Vector3d> u = weights.displacement(motions.maps, motions.turns, target.stretch);
  if (!edit.region.targets.empty()) {
    const std::vector<double> still(edit.column_count(), 0.0);
    const std::vector<Vector3d> drawn =
        laplacian_displacement(edit, edit.prescribed_displacement(still));
    for (const Index v : edit.moving) u[v] += drawn[v];
  }
  return u;
}

void move_held(const EditSystem& edit, std::span<const Vector3d> last_prescribed,
               std::span<const Vector3d> prescribed, std::span<const Vector3d> last,
               std::span<Vector3d> u) {
  for (const Index v : edit.region.belt) u[v] = last[v];
  for (const auto& handle : edit.region.handles) {
    for (const Index v : handle) u[v] = last[v] + (prescribed[v] - last_prescribed[v]);
  }
}

}  // namespace lapwing
