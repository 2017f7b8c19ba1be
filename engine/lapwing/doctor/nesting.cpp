#include "lapwing/doctor/nesting.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include <Eigen/Geometry>

#include "lapwing/base/cancellation.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

// Returns whether the ray from `p` along +x crosses the segment, both projected to the xy plane.
// The result does not depend on the direction of the segment. Two triangles thus get the same
// result for their common edge, and no ray passes between them.
bool passes(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
  if ((a.y() > p.y()) == (b.y() > p.y())) return false;
  const Vector3d& low = a.y() < b.y() ? a : b;
  const Vector3d& high = a.y() < b.y() ? b : a;
  const double x = low.x() + (p.y() - low.y()) / (high.y() - low.y()) * (high.x() - low.x());
  return p.x() < x;
}

// Returns whether the ray from `p` along +z crosses the triangle. If `p` is inside a closed
// surface, the ray crosses an odd number of its triangles, independent of their orientation.
bool crosses(const Vector3d& p, const std::array<Vector3d, 3>& triangle) {
  int turns = 0;  // winding number of the triangle around the ray
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3d& from = triangle[k];
    const Vector3d& to = triangle[(k + 1) % 3];
    if (passes(p, from, to)) turns += to.y() > from.y() ? 1 : -1;
  }
  const Vector3d normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
  return turns * normal.dot(p - triangle[0]) < 0.0;
}

class Nesting {
 public:
  Nesting(const Mesh& mesh, std::span<const ClosedSheet> sheets) : mesh_(mesh), sheets_(sheets) {
    for (Index s = 0; s < sheets.size(); ++s) {
      points_.emplace_back(mesh.positions[mesh.face(sheets[s].faces[0])[0]], s);
    }
    std::ranges::sort(points_, {}, [](const Point& p) { return std::pair(p.first.x(), p.second); });
  }

  void add_faces(Index sheet) {
    for (const Index f : sheets_[sheet].faces) {
      cancel_check_();
      const auto polygon = mesh_.face(f);
      for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
        add_triangle(sheet, {mesh_.positions[polygon[0]], mesh_.positions[polygon[k]],
                             mesh_.positions[polygon[k + 1]]});
      }
    }
  }

  std::vector<std::vector<Index>> containers() const {
    std::vector<std::vector<Index>> containers(sheets_.size());
    for (const auto& [pair, is_odd] : crossings_) {
      if (is_odd) containers[pair.first].push_back(pair.second);
    }
    return containers;
  }

 private:
  using Point = std::pair<Vector3d, Index>;

  void add_triangle(Index sheet, const std::array<Vector3d, 3>& triangle) {
    const auto [first, last] = std::minmax({triangle[0].x(), triangle[1].x(), triangle[2].x()});
    const auto x_of = [](const Point& p) { return p.first.x(); };
    auto point = std::ranges::lower_bound(points_, first, {}, x_of);
    for (; point != points_.end() && point->first.x() <= last; ++point) {
      const Index inner = point->second;
      if (std::abs(sheets_[sheet].volume) <= std::abs(sheets_[inner].volume)) continue;
      if (!crosses(point->first, triangle)) continue;
      bool& is_odd = crossings_[{inner, sheet}];
      is_odd = !is_odd;
    }
  }

  const Mesh& mesh_;
  std::span<const ClosedSheet> sheets_;
  std::vector<Point> points_;  // sorted by x
  // For each pair (inner, outer): whether the ray crosses `outer` an odd number of times.
  std::map<std::pair<Index, Index>, bool> crossings_;
  CancelCheck cancel_check_;
};

}  // namespace

std::vector<std::vector<Index>> containers_of(const Mesh& mesh,
                                              std::span<const ClosedSheet> sheets) {
  Nesting nesting(mesh, sheets);
  for (Index s = 0; s < sheets.size(); ++s) nesting.add_faces(s);
  return nesting.containers();
}

}  // namespace lapwing
