#pragma once

#include <span>
#include <vector>

#include "lapwing/mesh/topology.h"

namespace lapwing {

/// A surface with fewer vertices, all of them vertices that it had.
struct Decimated {
  std::vector<Index> kept;          ///< own number -> vertex, ascending
  std::vector<Triangle> triangles;  ///< own numbers
  /// Per vertex, the own number of the one that it went into; kNoIndex without triangles.
  std::vector<Index> owners;
};

/// Group of a vertex that is kept.
inline constexpr Index kKeptGroup = kNoIndex;

/// Merges vertices into neighbours of the same group until about `count` are left, those first
/// whose going changes the surface least: quadric error, and a little of the fourth power of the
/// edge, so that flat parts keep triangles of one size. No triangle folds over or becomes a needle,
/// boundaries go along themselves, and vertices of edges with more than two triangles and where
/// fans meet are kept; more than `count` are left where that forbids most of the rest. `groups`:
/// one per vertex, or kKeptGroup. Same result for any number of threads. Linear in the size at each
/// of some dozen passes, each of which takes a fifth away. Based on: Garland, Heckbert, "Surface
/// Simplification Using Quadric Error Metrics", 1997. Throws Cancelled.
Decimated decimate(std::span<const Eigen::Vector3d> positions, std::vector<Triangle> triangles,
                   std::span<const Index> groups, std::size_t count);

}  // namespace lapwing
