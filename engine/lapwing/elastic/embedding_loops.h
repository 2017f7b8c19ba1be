#pragma once

#include <cstddef>
#include <cstdint>

#include "lapwing/base/instruction_set.h"

namespace lapwing {

/// The largest number of coarse vertices that a fine one follows.
inline constexpr std::size_t kEmbeddingNodes = 8;

/// The coarse vertices that a fine vertex follows, with their weights.
struct EmbeddedVertex {
  std::uint32_t nodes[kEmbeddingNodes] = {};
  double weights[kEmbeddingNodes] = {};  ///< 0 for unused nodes
};

/// x -> (A - I) x + t, by rows: three numbers of A - I, and one of t.
struct alignas(32) RowsOfMotion {
  double row[3][4];
};

/// The vertices to move and the motions to apply.
struct CarriedVertices {
  const std::uint32_t* vertices;   ///< of the fine mesh
  const EmbeddedVertex* embedded;  ///< per entry of `vertices`
  const RowsOfMotion* motions;     ///< per coarse vertex, about `origin`
  const double* rest;              ///< three numbers per vertex of the fine mesh
  double origin[3];
};

/// The loops of CoarseEmbedding, for one instruction set.
struct EmbeddingLoops {
  /// Moves vertices[first, last), now at rest + u, by their weighted motions.
  void (*carry)(const CarriedVertices& carried, std::size_t first, std::size_t last, double* u);
};

/// `set` must be available.
const EmbeddingLoops& embedding_loops(InstructionSet set);

}  // namespace lapwing
