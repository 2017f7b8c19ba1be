#pragma once

#include <cstddef>
#include <cstdint>

#include "lapwing/base/instruction_set.h"

namespace lapwing {

/// The largest number of coarse vertices that a fine vertex follows.
inline constexpr std::size_t kEmbeddingNodes = 8;

/// The coarse vertices that a fine vertex follows, with their weights.
struct EmbeddedVertex {
  std::uint32_t nodes[kEmbeddingNodes] = {};
  double weights[kEmbeddingNodes] = {};  ///< 0 for unused nodes
};

/// The map x -> (A - I) x + t. Each row contains three entries of A - I and one of t.
struct alignas(32) RowsOfMotion {
  double row[3][4];
};

/// The vertices to move and the motions to apply.
struct CarriedVertices {
  const std::uint32_t* vertices;   ///< vertex numbers in the fine mesh
  const EmbeddedVertex* embedded;  ///< per entry of `vertices`
  const RowsOfMotion* motions;     ///< per coarse vertex, in coordinates relative to `origin`
  const double* rest;              ///< rest positions, three numbers per vertex of the fine mesh
  double origin[3];
};

/// The inner loop of CoarseEmbedding for one instruction set.
struct EmbeddingLoops {
  /// Adds the weighted motions to the displacements `u` of vertices[first, last).
  void (*carry)(const CarriedVertices& carried, std::size_t first, std::size_t last, double* u);
};

/// Returns the loop for `set`, which the CPU must support.
const EmbeddingLoops& embedding_loops(InstructionSet set);

}  // namespace lapwing
