#pragma once

#include <array>
#include <span>
#include <vector>

#include "lapwing/mesh/mesh.h"

namespace lapwing {

using Triangle = std::array<Index, 3>;

/// A list of lists in compressed rows: row i is `values[starts[i], starts[i+1])`.
struct Adjacency {
  std::vector<Index> starts{0};
  std::vector<Index> values;

  std::size_t row_count() const { return starts.size() - 1; }
  std::size_t size(std::size_t i) const { return starts[i + 1] - starts[i]; }
  std::span<const Index> operator[](std::size_t i) const {
    return std::span(values).subspan(starts[i], starts[i + 1] - starts[i]);
  }
};

/// What the mathematics needs to know of a mesh's connectivity. Depends on the polygons only (and,
/// where a polygon is not convex, on the positions that decide how it is cut into triangles).
struct Topology {
  std::vector<Triangle> triangles;    ///< polygons cut into triangles; degenerate corners dropped
  std::vector<Index> triangle_faces;  ///< the polygon each triangle came from
  /// One-ring N_i: every vertex that shares a triangle edge with i, in both directions, on the
  /// boundary or not, ascending, without i and without repeats.
  Adjacency rings;
  /// The triangles around each vertex, ascending.
  Adjacency vertex_triangles;

  std::size_t vertex_count() const { return rings.row_count(); }
};

/// Builds the topology of `mesh`. Linear in its size. Triangles that name one vertex twice are left
/// out. Throws InputError when a face names a vertex that the mesh does not have.
Topology build_topology(const Mesh& mesh);

/// The triangles around each vertex, ascending. Linear time.
Adjacency triangles_around_vertices(std::size_t vertex_count, std::span<const Triangle> triangles);

/// The one-ring of each vertex, as in Topology. `vertex_triangles` as above.
Adjacency rings_by_triangles(const Adjacency& vertex_triangles,
                             std::span<const Triangle> triangles);

/// Cuts one polygon into triangles that keep its orientation: a triangle as it is, a convex polygon
/// as a fan from its first corner, any other by clipping ears in its mean plane. Appends to
/// `triangles`. Corners keep their order, so the result depends only on the polygon's shape.
void triangulate_polygon(std::span<const Index> polygon, std::span<const Eigen::Vector3d> positions,
                         std::vector<Triangle>& triangles);

/// Connected component of each vertex along ring edges, numbered by smallest vertex, and their
/// number. A vertex with an empty ring is a component of its own.
struct Components {
  std::vector<Index> of_vertex;
  std::size_t count = 0;
};
Components connected_components(const Adjacency& rings);

/// Where each of 0 .. count - 1 is in `list`, whose entries differ; kNoIndex where it is not.
/// Entries that are kNoIndex are passed over.
std::vector<Index> places_in(std::span<const Index> list, std::size_t count);

/// Every place in `list` of each of 0 .. count - 1, ascending. Entries that are kNoIndex are passed
/// over. Linear time.
Adjacency all_places_in(std::span<const Index> list, std::size_t count);

/// Triangles in numbers of their own.
struct NumberedTriangles {
  std::vector<Index> vertices;      ///< own number -> the vertex it was, ascending
  std::vector<Triangle> triangles;  ///< own numbers, in the order given
};
/// Linear in the largest vertex that is named.
NumberedTriangles numbered(std::span<const Triangle> triangles);

/// `vertices` and their ring neighbours, ascending.
std::vector<Index> with_ring_neighbours(std::span<const Index> vertices, const Adjacency& rings);

/// Mean length of the ring edges; 0 without edges.
double mean_edge_length(const Adjacency& rings, std::span<const Eigen::Vector3d> positions);

}  // namespace lapwing
