#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "lapwing/mesh/topology.h"

namespace lapwing {

/// Merges of vertices into neighbours, one after the other: about 40 bytes each.
struct MergeHistory {
  std::vector<std::array<Index, 2>> merges;  ///< from, into
  Adjacency beside;  ///< of each merge, the neighbours of its `from` then, some of them twice
};

/// A surface with fewer vertices, all of them vertices that it had.
struct Decimated {
  std::vector<Index> kept;          ///< own number -> vertex, ascending
  std::vector<Triangle> triangles;  ///< own numbers
  /// Per vertex, the own number of the one that it went into; kNoIndex without triangles.
  std::vector<Index> owners;
  MergeHistory history;  ///< of `decimate`; empty after `decimate_again`
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

/// The same in two steps: what comes before the first merge, about a sixth of the time, and the
/// rest.
class Decimator {
 public:
  Decimator(std::span<const Eigen::Vector3d> positions, std::vector<Triangle> triangles,
            std::span<const Index> groups);
  ~Decimator();

  /// To be called once.
  Decimated decimate(std::size_t count);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The same surface decimated for other groups, in a fraction of the time where few borders are
/// new: the merges of `before` are made again without asking for them, but for those across a
/// border and those that come after and next to one left out; then goes on as `decimate`. Borders
/// that are no more leave their mark. Nothing where more than half of the vertices are left to go
/// on with: decimate anew. Based on: Hoppe, "Progressive Meshes", 1996, of whose vertex splits the
/// others are those that nothing new depends on.
std::optional<Decimated> decimate_again(const MergeHistory& before,
                                        std::span<const Eigen::Vector3d> positions,
                                        std::span<const Triangle> triangles,
                                        std::span<const Index> groups, std::size_t count);

}  // namespace lapwing
