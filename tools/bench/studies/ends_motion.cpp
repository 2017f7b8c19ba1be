#include "studies/ends_motion.h"

#include <algorithm>
#include <numbers>
#include <numeric>

#include "lapwing/base/errors.h"
#include "lapwing/region/submesh.h"

namespace lapwing::bench {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kLeastHeld = 3;

std::vector<Index> vertices_along(Eigen::Index axis, std::span<const Vector3d> positions) {
  std::vector<Index> order(positions.size());
  std::iota(order.begin(), order.end(), Index{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](Index a, Index b) { return positions[a][axis] < positions[b][axis]; });
  return order;
}

Vector3d mean_of(const VertexSet& vertices, std::span<const Vector3d> positions) {
  Vector3d sum = Vector3d::Zero();
  for (const Index v : vertices) sum += positions[v];
  return sum / static_cast<double>(vertices.size());
}

bool is_held(const EditRegion& component, std::span<const Eigen::Vector3d> positions,
             const Topology& topology) {
  try {
    check_anchors(component, positions, topology, "component");
    return true;
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace

std::string_view name_of(EndsMotion motion) {
  return motion == EndsMotion::lift ? "lift" : "lean";
}

MovedEnds moved_ends(EndsMotion motion, std::span<const Vector3d> positions) {
  const std::size_t n = positions.size();
  if (n < 2 * kLeastHeld) throw InputError("too few vertices for two ends");
  for (const Vector3d& p : positions) {
    if (!p.allFinite()) throw InputError("a position that is not finite");
  }
  const bool is_lift = motion == EndsMotion::lift;
  const Bounds bounds = bounds_of(positions);
  Eigen::Index axis = 1;
  if (is_lift) (bounds.max - bounds.min).maxCoeff(&axis);
  const std::vector<Index> order = vertices_along(axis, positions);
  const auto count = static_cast<std::ptrdiff_t>(std::max(kLeastHeld, n / (is_lift ? 10 : 20)));

  MovedEnds ends;
  ends.belt = make_vertex_set({order.begin(), order.begin() + count});
  ends.handle = make_vertex_set({order.end() - count, order.end()});
  if (is_lift) {
    ends.map.translate(0.1 * bounds.diagonal() * Vector3d::Unit((axis + 1) % 3));
    return ends;
  }
  const Vector3d pivot = mean_of(ends.handle, positions);
  ends.map = Eigen::Translation3d(pivot + 0.2 * bounds.diagonal() * Vector3d::UnitX()) *
             Eigen::AngleAxisd(-std::numbers::pi / 6.0, Vector3d::UnitZ()) *
             Eigen::Translation3d(-pivot);
  return ends;
}

HeldRegion held_region(const MovedEnds& ends, std::span<const Eigen::Vector3d> positions,
                       const Topology& topology) {
  VertexSet all(topology.vertex_count());
  std::iota(all.begin(), all.end(), Index{0});
  std::vector<Index> held;
  for (const VertexSet& component : region_components(all, topology)) {
    const EditRegion alone{
        component, intersect(component, ends.belt), {intersect(component, ends.handle)}};
    if (!is_held(alone, positions, topology)) continue;
    held.insert(held.end(), component.begin(), component.end());
  }
  HeldRegion result;
  EditRegion& region = result.region;
  region.roi = make_vertex_set(std::move(held));
  region.belt = intersect(region.roi, ends.belt);
  region.handles.push_back(intersect(region.roi, ends.handle));
  result.left_out = all.size() - region.roi.size();
  if (region.belt.empty()) throw InputError("no component is held by the belt");
  if (region.handles[0].empty()) throw InputError("no component is held by the handle");
  return result;
}

}  // namespace lapwing::bench
