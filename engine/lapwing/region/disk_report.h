#pragma once

#include <array>
#include <string>
#include <vector>

#include "lapwing/region/submesh.h"

namespace lapwing {

/// The topology of a region's triangles, which determines whether they form a disk. Vertices are
/// vertices of the mesh.
struct DiskReport {
  struct Piece {
    std::size_t triangles = 0;
    Index vertex = 0;  ///< smallest vertex
  };
  struct Loop {
    std::size_t vertices = 0;
    Index vertex = 0;  ///< smallest vertex
  };

  std::vector<Piece> pieces;  ///< components of edge-connected triangles, sorted by smallest vertex
  std::vector<Loop> loops;    ///< boundary loops, sorted by smallest vertex
  long euler_characteristic = 0;  ///< vertices - edges + triangles
  long handles = 0;               ///< sum of the genera; 0 if any edge is listed below
  std::vector<std::array<Index, 2>> non_manifold_edges;  ///< edges with more than two triangles
  std::vector<std::array<Index, 2>> turned_edges;  ///< edges of inconsistently oriented triangles
  VertexSet pinched;                               ///< vertices with several fans of triangles
  VertexSet loose;                                 ///< vertices in no triangle; ignored

  /// Returns whether the region is manifold, consistently oriented and connected, with one boundary
  /// loop and Euler characteristic 1.
  bool is_disk() const;
};

DiskReport report_disk(const RegionTriangles& part);
DiskReport report_disk(const RegionTriangles& part, const Adjacency& sides);

/// Returns the reason why the region is not a disk, as the predicate of a sentence: "has 2 boundary
/// loops (63 vertices from vertex 120, 14 vertices from vertex 988) and 1 handle". Returns "is a
/// disk" for a disk.
std::string describe(const DiskReport& report);

}  // namespace lapwing
