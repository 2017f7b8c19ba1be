#include "lapwing/parameterize/domain_locator.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/parallel.h"
#include "lapwing/mesh/edges.h"
#include "lapwing/parameterize/planar.h"

namespace lapwing {
namespace {

using Eigen::Vector2d;

// A cell lists all triangles within this fraction of the cell size, so that rounding errors lose no
// triangle.
constexpr double kCellSlack = 1e-6;

// Returns the parameter in [0, 1] of the point on segment ab that is nearest to p.
double nearest_share(const Vector2d& a, const Vector2d& b, const Vector2d& p) {
  const Vector2d edge = b - a;
  const double squared = edge.squaredNorm();
  return squared > 0.0 ? std::clamp((p - a).dot(edge) / squared, 0.0, 1.0) : 0.0;
}

struct Nearest {
  double distance = std::numeric_limits<double>::infinity();
  SurfacePoint point = SurfacePoint::nowhere();
};

struct Edge {
  Index from;
  Index to;
  Index apex;  // the third corner of the triangle at this edge
};

// Computes the x range of the part of a triangle between two values of y.
class Outline {
 public:
  Outline(const Vector2d& a, const Vector2d& b, const Vector2d& c) : corners_{a, b, c} {}

  Eigen::AlignedBox1d within(double low, double high) const {
    Eigen::AlignedBox1d range;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector2d& a = corners_[k];
      const Vector2d& b = corners_[(k + 1) % 3];
      if (a.y() >= low && a.y() <= high) extend(range, a.x());
      for (const double y : {low, high}) {
        if (std::min(a.y(), b.y()) < y && y < std::max(a.y(), b.y())) {
          extend(range, a.x() + (b.x() - a.x()) * ((y - a.y()) / (b.y() - a.y())));
        }
      }
    }
    return range;
  }

 private:
  static void extend(Eigen::AlignedBox1d& range, double x) {
    range.extend(Eigen::Matrix<double, 1, 1>(x));
  }
  std::array<Vector2d, 3> corners_;
};

}  // namespace

struct DomainLocator::Grid {
  Grid(std::span<const Triangle> triangle_list, std::span<const Vector2d> point_list)
      : triangles(triangle_list.begin(), triangle_list.end()),
        points(point_list.begin(), point_list.end()) {
    if (triangles.empty()) return;
    collect_boundary();
    lay_out();
    fill();
  }

  SurfacePoint locate(const Vector2d& p) const {
    if (triangles.empty() || !p.allFinite()) return SurfacePoint::nowhere();
    const auto candidates = cells[cell_of(p)];
    for (const Index t : candidates) {
      const SurfacePoint found = inside(t, p);
      if (!found.is_nowhere()) return found;
    }
    // The point is outside or, because of rounding errors, in neither triangle of an edge. Take the
    // nearest point.
    Nearest nearest;
    for (const Index t : candidates) {
      const auto& [a, b, c] = triangles[t];
      offer({a, b, c}, p, nearest);
      offer({b, c, a}, p, nearest);
      offer({c, a, b}, p, nearest);
    }
    for (const Edge& edge : boundary) offer(edge, p, nearest);
    return nearest.point;
  }

  std::vector<Triangle> triangles;
  std::vector<Vector2d> points;
  std::vector<Edge> boundary;
  Vector2d origin = Vector2d::Zero();
  Vector2d cell_size = Vector2d::Ones();
  std::array<Index, 2> counts{1, 1};
  Adjacency cells;

 private:
  void collect_boundary() {
    const Adjacency sides = sides_by_edge(triangles, points.size());
    for (std::size_t e = 0; e < sides.row_count(); ++e) {
      if (sides.size(e) != 1) continue;
      const Index side = sides[e][0];
      boundary.push_back({side_start(triangles, side), side_end(triangles, side),
                          triangles[side / 3][(side + 2) % 3]});
    }
  }

  // Chooses one cell per triangle on average. Cells are nearly square unless the triangulation is
  // degenerate.
  void lay_out() {
    Eigen::AlignedBox2d box;
    for (const Triangle& t : triangles) {
      for (const Index v : t) box.extend(points[v]);
    }
    origin = box.min();
    const double longest = box.sizes().maxCoeff();
    if (!(longest > 0.0)) return;
    const Vector2d sizes = box.sizes().cwiseMax(longest / static_cast<double>(triangles.size()));
    const double wanted = std::sqrt(sizes.prod() / static_cast<double>(triangles.size()));
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const double size = sizes[static_cast<Eigen::Index>(axis)];
      counts[axis] = static_cast<Index>(std::max(1.0, std::floor(size / wanted)));
      cell_size[static_cast<Eigen::Index>(axis)] = size / counts[axis];
    }
  }

  Index along(std::size_t axis, double x) const {
    const auto k = static_cast<Eigen::Index>(axis);
    const double cell = std::floor((x - origin[k]) / cell_size[k]);
    return static_cast<Index>(std::clamp(cell, 0.0, static_cast<double>(counts[axis] - 1)));
  }
  std::size_t cell_of(const Vector2d& p) const {
    return std::size_t{along(1, p.y())} * counts[0] + along(0, p.x());
  }

  // Calls `put(cell)` for each cell that triangle t may intersect.
  template <class Put>
  void for_cells(const Triangle& t, const Put& put) const {
    const Outline outline(points[t[0]], points[t[1]], points[t[2]]);
    const Vector2d slack = kCellSlack * cell_size;
    const auto [low, high] = std::minmax({points[t[0]].y(), points[t[1]].y(), points[t[2]].y()});
    const Index last_row = along(1, high + slack.y());
    for (Index row = along(1, low - slack.y()); row <= last_row; ++row) {
      const double bottom = origin.y() + row * cell_size.y();
      const Eigen::AlignedBox1d range =
          outline.within(bottom - slack.y(), bottom + cell_size.y() + slack.y());
      if (range.isEmpty()) continue;
      const Index last = along(0, range.max().x() + slack.x());
      for (Index column = along(0, range.min().x() - slack.x()); column <= last; ++column) {
        put(std::size_t{row} * counts[0] + column);
      }
    }
  }

  void fill() {
    cells.starts.assign(std::size_t{counts[0]} * counts[1] + 1, 0);
    std::vector<Index> reached;  // the cells of all triangles, concatenated
    std::vector<std::size_t> ends;
    reached.reserve(3 * triangles.size());
    ends.reserve(triangles.size());
    for (const Triangle& t : triangles) {
      for_cells(t, [&](std::size_t cell) {
        ++cells.starts[cell + 1];
        reached.push_back(static_cast<Index>(cell));
      });
      ends.push_back(reached.size());
    }
    for (std::size_t c = 1; c < cells.starts.size(); ++c) cells.starts[c] += cells.starts[c - 1];
    cells.values.resize(cells.starts.back());
    std::vector<Index> next(cells.starts.begin(), cells.starts.end() - 1);
    std::size_t k = 0;
    CancelCheck cancel_check;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      cancel_check();
      for (; k < ends[t]; ++k) cells.values[next[reached[k]]++] = static_cast<Index>(t);
    }
  }

  // Returns the barycentric coordinates of p in triangle t, or nowhere() if p is outside.
  SurfacePoint inside(Index t, const Vector2d& p) const {
    const Triangle& corners = triangles[t];
    const Vector2d a = points[corners[0]] - p;
    const Vector2d b = points[corners[1]] - p;
    const Vector2d c = points[corners[2]] - p;
    const double at_a = cross(b, c);
    const double at_b = cross(c, a);
    const double at_c = cross(a, b);
    const double sum = at_a + at_b + at_c;
    // In a flipped triangle, all coordinates of an inner point are negative.
    const double sign = sum < 0.0 ? -1.0 : 1.0;
    if (sum == 0.0 || sign * at_a < 0.0 || sign * at_b < 0.0 || sign * at_c < 0.0) {
      return SurfacePoint::nowhere();
    }
    return {corners, {at_a / sum, at_b / sum, at_c / sum}};
  }

  void offer(const Edge& edge, const Vector2d& p, Nearest& nearest) const {
    const Vector2d& a = points[edge.from];
    const Vector2d& b = points[edge.to];
    const double share = nearest_share(a, b, p);
    const double distance = (a + share * (b - a) - p).norm();
    if (!(distance < nearest.distance)) return;
    nearest = {distance, {{edge.from, edge.to, edge.apex}, {1.0 - share, share, 0.0}}};
  }
};

DomainLocator::DomainLocator(std::span<const Triangle> triangles, std::span<const Vector2d> points)
    : grid_(std::make_unique<Grid>(triangles, points)) {}
DomainLocator::~DomainLocator() = default;
DomainLocator::DomainLocator(DomainLocator&&) noexcept = default;
DomainLocator& DomainLocator::operator=(DomainLocator&&) noexcept = default;

SurfacePoint DomainLocator::locate(const Vector2d& point) const {
  return grid_->locate(point);
}

std::vector<SurfacePoint> DomainLocator::locate(std::span<const Vector2d> points) const {
  std::vector<SurfacePoint> found(points.size());
  constexpr std::size_t kPointsPerTask = 1024;
  parallel_for(points.size(), kPointsPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) found[k] = grid_->locate(points[k]);
  });
  return found;
}

}  // namespace lapwing
