#pragma once

#include <span>
#include <vector>

#include "lapwing/solve/dissection/mesh_dissection.h"

namespace lapwing::dissection {

/// Orders unknowns that are eliminated before all others they are coupled with. Uses minimum
/// degree, and those others count towards the degree ("halo"; Pellegrini, Roman, Amestoy 2000).
/// Reuses its memory between calls.
class LeafOrder {
 public:
  explicit LeafOrder(const CouplingGraph& graph);

  /// Sorts `unknowns` into the order of elimination.
  void sort(std::span<int> unknowns);

 private:
  const CouplingGraph& graph_;
  std::vector<int> place_;  // number of each node in the leaf, or -1
};

}  // namespace lapwing::dissection
