#pragma once

#include <cstddef>
#include <cstdint>

#include "lapwing/base/instruction_set.h"

namespace lapwing {

/// How many coarse vertices a fine one goes along with at most.
inline constexpr std::size_t kEmbeddingNodes = 8;

/// A fine vertex among the coarse ones.
struct EmbeddedVertex {
  std::uint32_t nodes[kEmbeddingNodes] = {};
  double weights[kEmbeddingNodes] = {};  ///< 0 for those that are not there
};

/// x -> (A - I) x + t, by rows: three numbers of A - I, and one of t.
struct alignas(32) RowsOfMotion {
  double row[3][4];
};

/// What is carried, and by what.
struct CarriedVertices {
  const std::uint32_t* vertices;   ///< of the fine mesh
  const EmbeddedVertex* embedded;  ///< of each of `vertices`
  const RowsOfMotion* motions;     ///< per coarse vertex, about `origin`
  const double* rest;              ///< three numbers per vertex of the fine mesh
  double origin[3];
};

/// The loops of CoarseEmbedding, for one instruction set.
struct EmbeddingLoops {
  /// Moves vertices[first, last), which are at rest + u, by their weighted motions.
  void (*carry)(const CarriedVertices& carried, std::size_t first, std::size_t last, double* u);
};

/// `set` is to be among the available ones.
const EmbeddingLoops& embedding_loops(InstructionSet set);

}  // namespace lapwing
