#include "lapwing/solve/dissection/separator.h"

#include <algorithm>
#include <utility>

#include "lapwing/solve/dissection/moves.h"

namespace lapwing::dissection {

ThickSeparator::ThickSeparator(const WeightedGraph& graph, Sides sides)
    : graph_(&graph),
      sides_(std::move(sides)),
      across_(graph.weights.size(), 0),
      visited_(graph.weights.size(), 0) {
  for (int v = 0; v < graph.size(); ++v) {
    int across = 0;
    for (int e = graph.starts[v]; e < graph.starts[v + 1]; ++e) {
      across += sides_[graph.neighbours[e]] != sides_[v] ? 1 : 0;
    }
    across_[v] = across;
    if (across > 0) value_ += graph.weights[v];
  }
}

int ThickSeparator::gain(int v) const {
  int result = 0;
  if (across_[v] > 0 && across_[v] == degree(v)) result += graph_->weights[v];
  if (across_[v] == 0 && degree(v) > 0) result -= graph_->weights[v];
  for (int e = graph_->starts[v]; e < graph_->starts[v + 1]; ++e) {
    const int u = graph_->neighbours[e];
    if (sides_[u] == sides_[v]) {
      if (across_[u] == 0) result -= graph_->weights[u];
    } else if (across_[u] == 1) {
      result += graph_->weights[u];
    }
  }
  return result;
}

void ThickSeparator::move(int v) {
  value_ -= gain(v);
  for (int e = graph_->starts[v]; e < graph_->starts[v + 1]; ++e) {
    const int u = graph_->neighbours[e];
    across_[u] += sides_[u] == sides_[v] ? 1 : -1;
  }
  sides_[v] = static_cast<unsigned char>(1 - sides_[v]);
  across_[v] = degree(v) - across_[v];
}

CutScore ThickSeparator::smooth(int most_passes) {
  // A long separator has larger bumps, and smoothing them takes more moves.
  const int patience = std::max(30, value_ / 3);
  Improvement improvement(*this, patience);
  improvement.run(most_passes);
  return improvement.score();
}

}  // namespace lapwing::dissection
