#pragma once

#include <span>
#include <vector>

#include "lapwing/solve/dissection/mesh_dissection.h"

namespace lapwing::dissection {

/// Orders a leaf, that is, a set of unknowns that are eliminated before all other unknowns coupled
/// with them. Uses minimum degree. The other coupled unknowns count towards the degree ("halo";
/// Pellegrini, Roman, Amestoy 2000). Reuses its memory between calls.
class LeafOrder {
 public:
  explicit LeafOrder(const CouplingGraph& graph);

  /// Sorts `unknowns` into elimination order.
  void sort(std::span<int> unknowns);

 private:
  const CouplingGraph& graph_;
  std::vector<int> place_;  // index of each node in the leaf, or -1
};

}  // namespace lapwing::dissection
