#include "lapwing/region/vertex_set.h"

#include <algorithm>
#include <iterator>

#include "lapwing/base/errors.h"

namespace lapwing {

VertexSet make_vertex_set(std::vector<Index> vertices) {
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

VertexSet unite(const VertexSet& a, const VertexSet& b) {
  VertexSet result;
  std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(result));
  return result;
}

VertexSet intersect(const VertexSet& a, const VertexSet& b) {
  VertexSet result;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(result));
  return result;
}

VertexSet subtract(const VertexSet& a, const VertexSet& b) {
  VertexSet result;
  std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(result));
  return result;
}

std::vector<char> vertex_mask(std::size_t vertex_count, std::span<const Index> members) {
  std::vector<char> mask(vertex_count, 0);
  for (const Index v : members) mask[v] = 1;
  return mask;
}

std::string name_vertices(std::span<const Index> vertices) {
  constexpr std::size_t kNamed = 8;
  std::string text = vertices.size() == 1 ? "vertex " : "vertices ";
  for (std::size_t k = 0; k < std::min(vertices.size(), kNamed); ++k) {
    if (k > 0) text += ", ";
    text += std::to_string(vertices[k]);
  }
  if (vertices.size() > kNamed)
    text += " and " + std::to_string(vertices.size() - kNamed) + " more";
  return text;
}

void require_finite(const VertexSet& region, std::span<const Eigen::Vector3d> positions,
                    const std::string& where) {
  VertexSet broken;
  for (const Index v : region) {
    if (!positions[v].allFinite()) broken.push_back(v);
  }
  if (broken.empty()) return;
  throw InputError(where + ": the region has a non-finite position at " + name_vertices(broken) +
                       ". Choose another region, or repair the mesh with `lapwing check --fix`",
                   broken);
}

}  // namespace lapwing
