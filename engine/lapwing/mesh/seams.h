#pragma once

#include <array>
#include <span>
#include <vector>

#include "lapwing/mesh/edges.h"
#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// Finds unwelded seams: groups of two or more boundary edges whose ends lie at exactly the same
/// two points but are different vertices. Each row lists the edges of one group, ascending. Skips
/// edges of zero length and edges with ends that are not finite. `first_at_position` is
/// `first_at_same_position(mesh.positions)`. Sorts the boundary edges.
Adjacency find_seams(const Mesh& mesh, const Edges& edges,
                     const std::vector<Index>& first_at_position);

/// Joins all edges of each seam into one edge, whatever their number and direction. Returns the
/// smallest vertex that each vertex is joined to, which off the seams is itself. Vertices at one
/// point that no seam joins stay separate. `seams` is the result of `find_seams`.
std::vector<Index> joined_at_seams(const Adjacency& seams, const Edges& edges,
                                   const std::vector<Index>& first_at_position);

/// The surface of a mesh with its seams (find_seams) joined. A mesh has seams if its polygons use
/// different vertices where they meet: a triangle soup, or a surface split along hard edges or
/// texture seams. Unlike `fix`, this keeps the vertex numbers. Of the vertices that are joined into
/// one, the smallest is the leader and the others follow it.
struct JoinedSurface {
  /// Leaders of the ends of each joined boundary edge. Empty if the mesh has no seam; then all
  /// other members are empty too.
  std::vector<std::array<Index, 2>> edges;
  std::vector<Index> leaders;    ///< per vertex: its leader, or itself
  std::vector<Index> followers;  ///< ascending
  /// The same vertices, with polygons that use leaders only. Has no attributes.
  Mesh surface;

  bool empty() const { return edges.empty(); }
  bool is_follower(Index v) const { return leaders[v] != v; }
  /// Returns whether every follower is at the position of its leader.
  bool is_closed_at(std::span<const Eigen::Vector3d> positions) const;
  /// Moves every follower exactly to its leader.
  void close(std::span<Eigen::Vector3d> positions) const;
};

/// Joins seams by exact position; faces without triangles join nothing. Linear if no two vertices
/// coincide, else near-linear. Throws InputError as `Mesh::topology` does.
JoinedSurface joined_surface(const Mesh& mesh);

}  // namespace lapwing
