// Based on: Barequet and Sharir, "Filling gaps in the boundary of a polyhedron", 1995.
#include "lapwing/fill/triangulate_rim.h"

#include <array>
#include <limits>
#include <numeric>

#include <Eigen/Geometry>

#include "lapwing/base/cancellation.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

// Weight of the squared edge lengths relative to the area. It decides only between triangulations
// of nearly equal area, such as those of a planar polygon.
constexpr double kEdgeShare = 1e-4;

double cost(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  return 0.5 * (b - a).cross(c - a).norm() +
         kEdgeShare * ((b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm());
}

}  // namespace

std::vector<Triangle> triangulate_rim(std::span<const Vector3d> rim,
                                      const std::function<bool(Index, Index)>& is_edge) {
  const std::size_t n = rim.size();
  std::vector<Triangle> triangles;
  if (n > kMostAreaVertices) {
    std::vector<Index> polygon(n);
    std::iota(polygon.begin(), polygon.end(), Index{0});
    triangulate_polygon(polygon, rim, triangles);
    return triangles;
  }
  // An existing edge costs more than all triangles together.
  double size = 0.0;
  for (const Vector3d& p : rim) size = std::max(size, (p - rim[0]).squaredNorm());
  const double penalty = 8.0 * static_cast<double>(n) * size;
  // Entry i n + j belongs to the polygon i, i + 1, ... j.
  std::vector<double> least(n * n, 0.0);
  std::vector<Index> apex(n * n, kNoIndex);
  for (std::size_t gap = 2; gap < n; ++gap) {
    check_cancelled();
    for (std::size_t i = 0; i + gap < n; ++i) {
      const std::size_t j = i + gap;
      double& best = least[i * n + j];
      best = std::numeric_limits<double>::infinity();
      for (std::size_t m = i + 1; m < j; ++m) {
        const double total = least[i * n + m] + least[m * n + j] + cost(rim[i], rim[m], rim[j]);
        if (total >= best) continue;
        best = total;
        apex[i * n + j] = static_cast<Index>(m);
      }
      const bool is_diagonal = gap + 1 < n;
      if (is_diagonal && is_edge(static_cast<Index>(i), static_cast<Index>(j))) best += penalty;
    }
  }
  std::vector<std::array<std::size_t, 2>> open{{0, n - 1}};
  while (!open.empty()) {
    const auto [i, j] = open.back();
    open.pop_back();
    if (j - i < 2) continue;
    const Index m = apex[i * n + j];
    triangles.push_back({static_cast<Index>(i), m, static_cast<Index>(j)});
    open.push_back({m, j});
    open.push_back({i, m});
  }
  return triangles;
}

}  // namespace lapwing
