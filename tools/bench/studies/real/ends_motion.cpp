#include "studies/real/ends_motion.h"

#include <algorithm>
#include <numbers>
#include <numeric>

#include "lapwing/base/errors.h"

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

}  // namespace lapwing::bench
