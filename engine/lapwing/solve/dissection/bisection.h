#pragma once

#include <vector>

#include "lapwing/solve/dissection/edge_cut.h"
#include "lapwing/solve/dissection/weighted_graph.h"

namespace lapwing::dissection {

/// Cuts of a graph in two, multilevel (Hendrickson, Leland 1995): the graph is grouped until few
/// nodes are left; those are swept; and what that finds is improved on each level. Any number of
/// threads may call it at the same time. Throws Cancelled.
class Bisection {
 public:
  /// `graph` must outlive it.
  explicit Bisection(const WeightedGraph& graph);

  /// A cut of the graph grouped to some thousand nodes. Attempts differ in how these are grouped
  /// further.
  EdgeCut attempt(std::size_t number) const;

  /// The sides of the whole graph that those of an attempt become.
  Sides refine(const EdgeCut& cut) const;

 private:
  struct Level {
    std::vector<int> group_of;  // of the nodes one level finer
    WeightedGraph graph;
  };

  // Levels on top of `finest`, until at most `size` nodes are left, or hardly any can be grouped.
  std::vector<Level> coarsen(const WeightedGraph& finest, int size, std::size_t variant) const;
  static EdgeCut refine(EdgeCut cut, const std::vector<Level>& levels, const WeightedGraph& finest);

  const WeightedGraph& graph_;
  int most_weight_;  // of a group
  std::vector<Level> levels_;
};

}  // namespace lapwing::dissection
