#pragma once

#include <utility>
#include <vector>

#include "lapwing/solve/dissection/cut_score.h"
#include "lapwing/solve/dissection/weighted_graph.h"

namespace lapwing::dissection {

/// The separator of a cut in a graph where nodes two edges apart are coupled: both ends of all cut
/// edges. Without these, nodes on different sides are at least three edges apart.
class ThickSeparator {
 public:
  /// Creates an empty separator, which can only be assigned to.
  ThickSeparator() = default;
  /// `graph` must outlive the separator.
  ThickSeparator(const WeightedGraph& graph, Sides sides);

  int size() const { return graph_->size(); }
  int weight(int v) const { return graph_->weights[v]; }
  int border(int v) const { return graph_->borders[v]; }
  int side(int v) const { return sides_[v]; }
  int value() const { return value_; }
  bool contains(int v) const { return across_[v] > 0; }

  /// Improves the cut by moving nodes to the other side, and returns its score.
  CutScore smooth(int most_passes);

  int separator() const { return value_; }
  bool on_border(int v) const { return contains(v); }
  int gain(int v) const;
  void move(int v);
  /// Calls visit(u) for v and every node at most two edges from it.
  template <typename Visit>
  void for_affected(int v, Visit visit) {
    ++visits_;
    const auto visit_once = [&](int u) {
      if (std::exchange(visited_[u], visits_) != visits_) visit(u);
    };
    for (int e = graph_->starts[v]; e < graph_->starts[v + 1]; ++e) {
      const int u = graph_->neighbours[e];
      visit_once(u);
      for (int f = graph_->starts[u]; f < graph_->starts[u + 1]; ++f) {
        visit_once(graph_->neighbours[f]);
      }
    }
  }

 private:
  int degree(int v) const { return graph_->starts[v + 1] - graph_->starts[v]; }

  const WeightedGraph* graph_ = nullptr;
  Sides sides_;
  std::vector<int> across_;  // for each node, its number of neighbours on the other side
  int value_ = 0;
  int visits_ = 0;
  std::vector<int> visited_;  // last visit of each node
};

}  // namespace lapwing::dissection
