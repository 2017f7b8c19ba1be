#pragma once

#include <span>
#include <vector>

#include "lapwing/mesh/topology.h"

namespace lapwing {

/// A decimated surface, whose vertices are a subset of the original ones.
struct Decimated {
  std::vector<Index> kept;          ///< new number -> original vertex, ascending
  std::vector<Triangle> triangles;  ///< in new numbers
  /// New number of the vertex that each original one was merged into; kNoIndex if it had no
  /// triangle.
  std::vector<Index> owners;
};

/// Group of vertices that must not be merged.
inline constexpr Index kKeptGroup = kNoIndex;

/// Merges vertices into neighbours of the same group until about `count` are left, those first that
/// change the surface least. The cost is the quadric error plus a small multiple of the fourth
/// power of the edge length, so that flat parts keep triangles of one size. No triangle folds over
/// or becomes a needle. Boundary vertices merge only along the boundary. Vertices on edges with
/// more than two triangles, or where fans meet, are kept. If these rules forbid most merges, more
/// than `count` are left. `groups` has one entry per vertex. The result does not depend on the
/// number of threads. Takes some dozen linear passes, each of which removes about a fifth of the
/// vertices. Based on Garland, Heckbert, "Surface Simplification Using Quadric Error Metrics",
/// 1997. Throws Cancelled.
Decimated decimate(std::span<const Eigen::Vector3d> positions, std::vector<Triangle> triangles,
                   std::span<const Index> groups, std::size_t count);

}  // namespace lapwing
