#pragma once

#include <span>
#include <string>
#include <vector>

#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// A set of vertices as a sorted list without duplicates.
using VertexSet = std::vector<Index>;

VertexSet make_vertex_set(std::vector<Index> vertices);
VertexSet unite(const VertexSet& a, const VertexSet& b);
VertexSet intersect(const VertexSet& a, const VertexSet& b);
VertexSet subtract(const VertexSet& a, const VertexSet& b);

/// Returns one entry per vertex: 1 for members, otherwise 0. Members must be below `vertex_count`.
std::vector<char> vertex_mask(std::size_t vertex_count, std::span<const Index> members);

/// Returns a list of vertices for messages: "vertex 4", "vertices 4, 5, 9", or the first eight "and
/// 12 more".
std::string name_vertices(std::span<const Index> vertices);

/// Throws InputError, naming `where` and the vertices, if positions of the region are not finite.
void require_finite(const VertexSet& region, std::span<const Eigen::Vector3d> positions,
                    const std::string& where);

}  // namespace lapwing
