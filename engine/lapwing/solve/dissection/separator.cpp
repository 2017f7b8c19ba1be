#include "lapwing/solve/dissection/separator.h"

#include "lapwing/solve/dissection/moves.h"

namespace lapwing::dissection {
ThickSeparator::ThickSeparator(const WeightedGraph& graph, Sides& sides)
    : graph_(graph), sides_(sides), across_(graph.weights.size(), 0) {
  for (int v = 0; v < graph.size(); ++v) {
    for (int e = graph.starts[v]; e < graph.starts[v + 1]; ++e) {
      across_[v] += sides[graph.neighbours[e]] != sides[v] ? 1 : 0;
    }
    if (across_[v] > 0) value_ += graph.weights[v];
  }
}

int ThickSeparator::gain(int v) const {
  int result = 0;
  if (across_[v] > 0 && across_[v] == degree(v)) result += graph_.weights[v];
  if (across_[v] == 0 && degree(v) > 0) result -= graph_.weights[v];
  for (int e = graph_.starts[v]; e < graph_.starts[v + 1]; ++e) {
    const int u = graph_.neighbours[e];
    if (sides_[u] == sides_[v]) {
      if (across_[u] == 0) result -= graph_.weights[u];
    } else if (across_[u] == 1) {
      result += graph_.weights[u];
    }
  }
  return result;
}

void ThickSeparator::move(int v) {
  value_ -= gain(v);
  for (int e = graph_.starts[v]; e < graph_.starts[v + 1]; ++e) {
    const int u = graph_.neighbours[e];
    across_[u] += sides_[u] == sides_[v] ? 1 : -1;
  }
  sides_[v] = static_cast<unsigned char>(1 - sides_[v]);
  across_[v] = degree(v) - across_[v];
}

void ThickSeparator::smooth() {
  constexpr int kPatience = 20;
  constexpr int kPasses = 2;
  Improvement improvement(*this, kPatience);
  improvement.run(kPasses);
}

}  // namespace lapwing::dissection
