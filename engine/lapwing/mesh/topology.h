#pragma once

#include <array>
#include <span>
#include <string>
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

/// The connectivity of a mesh. It depends only on the polygons and, if a polygon is not convex, on
/// the positions that decide how it is triangulated.
struct Topology {
  std::vector<Triangle> triangles;    ///< triangulated polygons, without degenerate triangles
  std::vector<Index> triangle_faces;  ///< the polygon each triangle came from
  /// One-ring N_i: all vertices that share a triangle edge with i, ascending and without repeats.
  /// The relation is symmetric, also on the boundary.
  Adjacency rings;
  /// The triangles around each vertex, ascending.
  Adjacency vertex_triangles;

  std::size_t vertex_count() const { return rings.row_count(); }
};

/// Builds the topology of `mesh` in linear time. Skips triangles that use a vertex twice. Throws
/// InputError if a face uses a vertex that the mesh does not have.
Topology build_topology(const Mesh& mesh);

/// Returns why `mesh` has no surface, such as "it has 4 vertices and no faces". Returns an empty
/// string if it has one, that is, at least one triangle with three finite corners.
std::string why_no_surface(const Mesh& mesh);

/// Throws InputError, with a message that begins with `where`, if `mesh` has no surface.
void require_surface(const Mesh& mesh, const std::string& where);

/// Returns the triangles around each vertex, ascending. Linear time.
Adjacency triangles_around_vertices(std::size_t vertex_count, std::span<const Triangle> triangles);

/// Returns the one-ring of each vertex, as in Topology.
Adjacency rings_by_triangles(const Adjacency& vertex_triangles,
                             std::span<const Triangle> triangles);

/// Appends a triangulation of one polygon, with its orientation, to `triangles`. A convex polygon
/// becomes a fan from its first corner. Any other is cut by ear clipping in its mean plane. Corners
/// keep their order, so the result depends only on the polygon's shape.
void triangulate_polygon(std::span<const Index> polygon, std::span<const Eigen::Vector3d> positions,
                         std::vector<Triangle>& triangles);

/// Connected components of the vertices along ring edges, numbered by smallest vertex. A vertex
/// with an empty ring is a component by itself.
struct Components {
  std::vector<Index> of_vertex;
  std::size_t count = 0;
};
Components connected_components(const Adjacency& rings);

/// Returns the index in `list` of each of 0 .. count - 1, or kNoIndex if it is not listed. Entries
/// must differ; those equal to kNoIndex are skipped.
std::vector<Index> inverse_index(std::span<const Index> list, std::size_t count);

/// Returns all indices in `list` of each of 0 .. count - 1, ascending. Skips entries equal to
/// kNoIndex. Linear time.
Adjacency inverse_lists(std::span<const Index> list, std::size_t count);

/// Triangles with compact vertex numbers.
struct NumberedTriangles {
  std::vector<Index> vertices;      ///< new number -> original vertex, ascending
  std::vector<Triangle> triangles;  ///< new numbers, in the order given
};
/// Numbers the vertices of `triangles` compactly. Linear in the largest vertex number.
NumberedTriangles numbered(std::span<const Triangle> triangles);

/// Returns `vertices` and their ring neighbours, ascending.
std::vector<Index> with_ring_neighbours(std::span<const Index> vertices, const Adjacency& rings);

/// Returns the positions of the vertices that triangles use, or all positions if `topology` has no
/// triangles. Cameras, and lengths relative to the bounding-box diagonal, use these positions, so
/// that distant isolated vertices have no effect. Linear time.
Positions surface_positions(std::span<const Eigen::Vector3d> positions, const Topology& topology);

/// Returns the mean length of the ring edges, or 0 without edges.
double mean_edge_length(const Adjacency& rings, std::span<const Eigen::Vector3d> positions);

}  // namespace lapwing
