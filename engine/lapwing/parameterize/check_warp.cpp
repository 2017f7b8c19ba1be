#include "lapwing/parameterize/check_warp.h"

#include <algorithm>
#include <numeric>
#include <sstream>
#include <string>

#include "lapwing/base/errors.h"
#include "lapwing/parameterize/planar.h"

namespace lapwing {
namespace {

using Eigen::Vector2d;

enum class Role : char { unused, inner, boundary, pulled };

[[noreturn]] void refuse(std::size_t pull, Index vertex, const std::string& why) {
  throw InputError(
      "pull " + std::to_string(pull) + " of vertex " + std::to_string(vertex) + ": " + why,
      {vertex});
}

std::string in_words(const Vector2d& p) {
  std::ostringstream text;
  text << "(" << p.x() << ", " << p.y() << ")";
  return text.str();
}

void check_domain(std::span<const Triangle> triangles, std::span<const Index> boundary,
                  std::span<const Vector2d> points) {
  const auto known = [&](Index v) { return v < points.size(); };
  if (!std::all_of(boundary.begin(), boundary.end(), known)) {
    throw InputError(
        "the boundary of the domain contains a vertex without a point; the domain has " +
        std::to_string(points.size()) + " points");
  }
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const Triangle& corners = triangles[t];
    if (std::all_of(corners.begin(), corners.end(), known) && doubled_area(corners, points) > 0.0) {
      continue;
    }
    throw InputError("triangle " + std::to_string(t) + " (vertices " + std::to_string(corners[0]) +
                     ", " + std::to_string(corners[1]) + ", " + std::to_string(corners[2]) +
                     ") of the domain is flipped or degenerate; a warp requires a bijective map");
  }
}

std::vector<Role> roles(std::span<const Triangle> triangles, std::span<const Index> boundary,
                        std::size_t size) {
  std::vector<Role> role(size, Role::unused);
  for (const Triangle& t : triangles) {
    for (const Index v : t) role[v] = Role::inner;
  }
  for (const Index v : boundary) role[v] = Role::boundary;
  return role;
}

void append_coinciding(std::span<const PointPull> pulls, double tolerance,
                       std::vector<Index>& found) {
  // Sorted by x, so that only close ones are compared.
  std::vector<Index> order(pulls.size());
  std::iota(order.begin(), order.end(), Index{0});
  std::sort(order.begin(), order.end(), [&](Index a, Index b) {
    return pulls[a].target.x() < pulls[b].target.x() ||
           (pulls[a].target.x() == pulls[b].target.x() && a < b);
  });
  for (std::size_t i = 0; i < order.size(); ++i) {
    for (std::size_t j = i + 1; j < order.size(); ++j) {
      const Vector2d apart = pulls[order[j]].target - pulls[order[i]].target;
      if (apart.x() > tolerance) break;
      if (apart.norm() <= tolerance) found.insert(found.end(), {order[i], order[j]});
    }
  }
}

}  // namespace

void check_warp(std::span<const Triangle> triangles, std::span<const Index> boundary,
                std::span<const Vector2d> points, std::span<const PointPull> pulls) {
  check_domain(triangles, boundary, points);
  std::vector<Role> role = roles(triangles, boundary, points.size());
  for (std::size_t k = 0; k < pulls.size(); ++k) {
    const auto& [vertex, target] = pulls[k];
    if (vertex >= points.size()) {
      refuse(k, vertex,
             "the vertex does not exist; the domain has " + std::to_string(points.size()) +
                 " vertices");
    }
    switch (role[vertex]) {
      case Role::unused:
        refuse(k, vertex, "the vertex belongs to no triangle; pull a vertex of a triangle");
      case Role::boundary:
        refuse(k, vertex,
               "the vertex is on the boundary, which a warp does not move; pull an inner vertex");
      case Role::pulled:
        refuse(k, vertex, "the vertex is already pulled; pull each vertex only once");
      case Role::inner:
        role[vertex] = Role::pulled;
    }
    if (!target.allFinite() || !is_inside(target, boundary, points)) {
      refuse(k, vertex,
             "the target " + in_words(target) +
                 " is not inside the boundary of the domain; choose a target inside it");
    }
  }
}

std::vector<Index> contradicting_pulls(std::span<const Triangle> triangles,
                                       std::span<const char> is_held,
                                       std::span<const Vector2d> points,
                                       std::span<const PointPull> pulls, double tolerance) {
  std::vector<Index> found;
  append_coinciding(pulls, tolerance, found);
  std::vector<Index> pull_of_vertex(points.size(), kNoIndex);
  std::vector<Vector2d> ends(points.begin(), points.end());
  for (Index k = 0; k < pulls.size(); ++k) {
    pull_of_vertex[pulls[k].vertex] = k;
    ends[pulls[k].vertex] = pulls[k].target;
  }
  for (const Triangle& t : triangles) {
    const bool is_settled = std::all_of(t.begin(), t.end(), [&](Index v) {
      return is_held[v] != 0 || pull_of_vertex[v] != kNoIndex;
    });
    if (!is_settled || doubled_area(t, ends) > 0.0) continue;
    for (const Index v : t) {
      if (pull_of_vertex[v] != kNoIndex) found.push_back(pull_of_vertex[v]);
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace lapwing
