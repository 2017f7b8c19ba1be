#pragma once

#include <array>
#include <span>
#include <vector>

#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// A mesh whose polygons name different vertices where they meet (a soup of triangles; a surface
/// split along its hard edges, or where its texture coordinates jump), and the surface that it is
/// with its seams (find_seams) joined: what `fix` makes of them, but vertices keep their numbers.
/// Of the vertices that are one there the smallest leads, and the others follow it.
struct JoinedSurface {
  /// The leaders of the ends of each boundary edge that is joined to another; empty where the mesh
  /// has no seam, and then all the rest is.
  std::vector<std::array<Index, 2>> edges;
  std::vector<Index> leaders;    ///< per vertex: its leader; itself where it follows none
  std::vector<Index> followers;  ///< ascending
  /// The same vertices; polygons name leaders, so that followers are in none. Without attributes.
  Mesh surface;

  bool empty() const { return edges.empty(); }
  bool is_follower(Index v) const { return leaders[v] != v; }
  /// Whether every follower is where its leader is; true where there is none.
  bool is_closed_at(std::span<const Eigen::Vector3d> positions) const;
  /// Puts every follower where its leader is, to the last bit.
  void close(std::span<Eigen::Vector3d> positions) const;
};

/// Joins by exact position; faces without extent join nothing. Linear where no two vertices
/// coincide, else near-linear. Throws InputError as `Mesh::topology` does.
JoinedSurface joined_surface(const Mesh& mesh);

}  // namespace lapwing
