#include "lapwing/parameterize/planar.h"

#include <algorithm>
#include <cmath>

namespace lapwing {

using Eigen::Vector2d;

bool is_bijective(std::span<const Triangle> triangles, std::span<const Vector2d> points) {
  return std::all_of(triangles.begin(), triangles.end(),
                     [&](const Triangle& t) { return doubled_area(t, points) > 0.0; });
}

double largest_step(std::span<const Triangle> triangles, std::span<const Vector2d> points,
                    std::span<const Vector2d> moves, double share) {
  double step = 1.0;
  for (const Triangle& t : triangles) {
    const Vector2d e = points[t[1]] - points[t[0]];
    const Vector2d f = points[t[2]] - points[t[0]];
    const Vector2d de = moves[t[1]] - moves[t[0]];
    const Vector2d df = moves[t[2]] - moves[t[0]];
    // The doubled area minus the part to keep is a + b s + c s^2. Its roots are 2a / (-b +-
    // sqrt(discriminant)); the larger denominator gives the smallest positive root.
    const double a = (1.0 - share) * cross(e, f);
    const double b = cross(e, df) + cross(de, f);
    const double c = cross(de, df);
    const double discriminant = b * b - 4.0 * a * c;
    if (discriminant < 0.0) continue;
    const double denominator = std::sqrt(discriminant) - b;
    if (denominator > 2.0 * a) step = std::min(step, 2.0 * a / denominator);
  }
  return step;
}

std::vector<Vector2d> moved(std::span<const Vector2d> points, std::span<const Vector2d> moves,
                            double step) {
  std::vector<Vector2d> result(points.begin(), points.end());
  for (std::size_t v = 0; v < points.size(); ++v) {
    // Skip zero moves, because -0 + 0 would give +0.
    for (const int c : {0, 1}) {
      if (moves[v][c] != 0.0) result[v][c] += step * moves[v][c];
    }
  }
  return result;
}

double extent(std::span<const Triangle> triangles, std::span<const Vector2d> points) {
  double doubled = 0.0;
  for (const Triangle& t : triangles) doubled += doubled_area(t, points);
  return std::sqrt(0.5 * doubled);
}

bool is_inside(const Vector2d& point, std::span<const Index> polygon,
               std::span<const Vector2d> points) {
  // Number of edges that cross the ray from `point` towards +x upwards, minus those that cross it
  // downwards.
  int winding = 0;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vector2d a = points[polygon[k]] - point;
    const Vector2d b = points[polygon[(k + 1) % polygon.size()]] - point;
    const double side = cross(a, b);
    if (side == 0.0 && a.dot(b) <= 0.0) return false;
    if (a.y() <= 0.0 && b.y() > 0.0 && side > 0.0) ++winding;
    if (a.y() > 0.0 && b.y() <= 0.0 && side < 0.0) --winding;
  }
  return winding != 0;
}

}  // namespace lapwing
