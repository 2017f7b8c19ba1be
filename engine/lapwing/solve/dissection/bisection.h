#pragma once

#include <vector>

#include "lapwing/solve/dissection/cut_score.h"
#include "lapwing/solve/dissection/weighted_graph.h"

namespace lapwing::dissection {

/// A cut of a graph into two sides. Its score uses the weight of the cut edges as an estimate of
/// the separator's size.
struct EdgeCut {
  CutScore score;
  Sides sides;
};

/// Multilevel bisection of a graph (Hendrickson, Leland 1995). Groups the nodes until few groups
/// are left, cuts this graph by sweeps, and improves the cut on every level. Any number of threads
/// may call an object at the same time. Throws Cancelled.
class Bisection {
 public:
  /// `graph` must outlive the Bisection.
  explicit Bisection(const WeightedGraph& graph);

  /// Returns a cut of the graph after grouping it to a few thousand nodes. `number` determines how
  /// the attempt groups these nodes further.
  EdgeCut attempt(std::size_t number) const;

  /// Refines the cut of an attempt to the whole graph, and returns the side of each node.
  Sides refine(const EdgeCut& cut) const;

 private:
  struct Level {
    std::vector<int> group_of;  // group of each node of the next finer level
    WeightedGraph graph;
  };

  // Returns levels of successively coarser graphs, until at most `size` nodes are left or grouping
  // hardly reduces the graph.
  std::vector<Level> coarsen(const WeightedGraph& finest, int size, std::size_t variant) const;
  static EdgeCut refine(EdgeCut cut, const std::vector<Level>& levels, const WeightedGraph& finest);

  const WeightedGraph& graph_;
  int most_weight_;  // largest weight of a group
  std::vector<Level> levels_;
};

}  // namespace lapwing::dissection
