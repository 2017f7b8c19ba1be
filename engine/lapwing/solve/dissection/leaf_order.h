#pragma once

#include <span>
#include <vector>

#include "lapwing/solve/dissection/coupling_graph.h"

namespace lapwing::dissection {

/// Orders unknowns that are eliminated before all that they are coupled with: by minimum degree,
/// where those others count towards the degree (Pellegrini, Roman, Amestoy 2000, "halo"). Keeps
/// memory from call to call.
class LeafOrder {
 public:
  explicit LeafOrder(const CouplingGraph& graph);

  /// Brings `unknowns` into order.
  void sort(std::span<int> unknowns);

 private:
  const CouplingGraph& graph_;
  std::vector<int> place_;  // by node: its number in the leaf, or -1
};

}  // namespace lapwing::dissection
