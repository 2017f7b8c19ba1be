#pragma once

#include "lapwing/solve/dissection/bisection.h"

namespace lapwing::dissection {

/// The separator that a cut makes where nodes two edges apart are coupled: the ends of all cut
/// edges. Whoever is not one of them is three edges or more from the other side.
class ThickSeparator {
 public:
  ThickSeparator(const WeightedGraph& graph, Sides& sides);

  int size() const { return graph_.size(); }
  int weight(int v) const { return graph_.weights[v]; }
  int side(int v) const { return sides_[v]; }
  /// What the separator weighs.
  int value() const { return value_; }
  bool contains(int v) const { return across_[v] > 0; }

  /// Moves nodes from one side to the other where that makes the separator lighter.
  void smooth();

  int separator() const { return value_; }
  bool on_border(int v) const { return contains(v); }
  int gain(int v) const;
  void move(int v);
  template <typename Visit>
  void for_affected(int v, Visit visit) const {
    for (int e = graph_.starts[v]; e < graph_.starts[v + 1]; ++e) {
      const int u = graph_.neighbours[e];
      visit(u);
      for (int f = graph_.starts[u]; f < graph_.starts[u + 1]; ++f) visit(graph_.neighbours[f]);
    }
  }

 private:
  int degree(int v) const { return graph_.starts[v + 1] - graph_.starts[v]; }

  const WeightedGraph& graph_;
  Sides& sides_;
  std::vector<int> across_;  // of each node: its neighbours on the other side
  int value_ = 0;
};

}  // namespace lapwing::dissection
