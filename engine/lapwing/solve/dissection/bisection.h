#pragma once

#include <vector>

#include "lapwing/solve/dissection/cut_score.h"
#include "lapwing/solve/dissection/weighted_graph.h"

namespace lapwing::dissection {

/// A cut of a graph in two. For its score, the weight of the cut edges stands for the separator.
struct EdgeCut {
  CutScore score;
  Sides sides;
};

/// Multilevel bisection of a graph (Hendrickson, Leland 1995). Groups the nodes until few are left,
/// sweeps these, and improves the cut on every level. Any number of threads may call it at the same
/// time. Throws Cancelled.
class Bisection {
 public:
  /// `graph` must outlive it.
  explicit Bisection(const WeightedGraph& graph);

  /// Returns a cut of the graph grouped to some thousand nodes. Attempts differ in how they group
  /// these further.
  EdgeCut attempt(std::size_t number) const;

  /// Returns the sides of the whole graph, refined from the cut of an attempt.
  Sides refine(const EdgeCut& cut) const;

 private:
  struct Level {
    std::vector<int> group_of;  // group of each node one level finer
    WeightedGraph graph;
  };

  // Returns levels on top of `finest`, until at most `size` nodes are left or hardly any can be
  // grouped.
  std::vector<Level> coarsen(const WeightedGraph& finest, int size, std::size_t variant) const;
  static EdgeCut refine(EdgeCut cut, const std::vector<Level>& levels, const WeightedGraph& finest);

  const WeightedGraph& graph_;
  int most_weight_;  // largest weight of a group
  std::vector<Level> levels_;
};

}  // namespace lapwing::dissection
