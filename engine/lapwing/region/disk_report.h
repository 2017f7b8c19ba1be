#pragma once

#include <array>
#include <string>
#include <vector>

#include "lapwing/region/region_triangles.h"

namespace lapwing {

/// What a region's triangles are, as far as it matters for being a disk. Vertices are those of the
/// mesh.
struct DiskReport {
  struct Piece {
    std::size_t triangles = 0;
    Index vertex = 0;  ///< the smallest
  };
  struct Loop {
    std::size_t vertices = 0;
    Index vertex = 0;  ///< the smallest
  };

  std::vector<Piece> pieces;      ///< of triangles joined over edges, by smallest vertex
  std::vector<Loop> loops;        ///< of the boundary, by smallest vertex
  long euler_characteristic = 0;  ///< vertices - edges + triangles
  long handles = 0;               ///< over all pieces; 0 where an edge is crowded or turned
  std::vector<std::array<Index, 2>> crowded_edges;  ///< those with more than two triangles
  std::vector<std::array<Index, 2>> turned_edges;   ///< their two triangles face opposite ways
  VertexSet
      pinched;      ///< vertices where parts touch without a common edge: several fans around them
  VertexSet loose;  ///< vertices in no triangle; they do not count

  /// One piece with one boundary loop, Euler characteristic 1, manifold and oriented.
  bool is_disk() const;
};

DiskReport report_disk(const RegionTriangles& part);
DiskReport report_disk(const RegionTriangles& part, const Adjacency& sides);

/// What there is beside or in place of a disk, to stand behind "it": "has 2 boundary loops (63
/// vertices from vertex 120, 14 vertices from vertex 988) and 1 handle"; for a disk "is a disk".
std::string describe(const DiskReport& report);

}  // namespace lapwing
