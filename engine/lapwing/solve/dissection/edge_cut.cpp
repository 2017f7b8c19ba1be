#include "lapwing/solve/dissection/edge_cut.h"

#include <utility>

namespace lapwing::dissection {
namespace {

class CutEdges {
 public:
  CutEdges(const WeightedGraph& graph, Sides& sides)
      : graph_(graph),
        sides_(sides),
        outside_(graph.weights.size()),
        inside_(graph.weights.size()) {
    for (int v = 0; v < graph.size(); ++v) {
      int all = 0;
      int outside = 0;
      for (int e = graph.starts[v]; e < graph.starts[v + 1]; ++e) {
        all += graph.edge_weights[e];
        outside += is_cut(v, e) ? graph.edge_weights[e] : 0;
      }
      outside_[v] = outside;
      inside_[v] = all - outside;
      value_ += outside;
    }
    value_ /= 2;
  }

  int size() const { return graph_.size(); }
  int weight(int v) const { return graph_.weights[v]; }
  int border(int v) const { return graph_.borders[v]; }
  int side(int v) const { return sides_[v]; }
  int separator() const { return value_; }
  bool on_border(int v) const { return outside_[v] > 0; }
  int gain(int v) const { return outside_[v] - inside_[v]; }
  void move(int v) {
    value_ -= gain(v);
    sides_[v] = static_cast<unsigned char>(1 - sides_[v]);
    std::swap(outside_[v], inside_[v]);
    for (int e = graph_.starts[v]; e < graph_.starts[v + 1]; ++e) {
      const int u = graph_.neighbours[e];
      const int weight = is_cut(v, e) ? graph_.edge_weights[e] : -graph_.edge_weights[e];
      outside_[u] += weight;
      inside_[u] -= weight;
    }
  }
  template <typename Visit>
  void for_affected(int v, Visit visit) const {
    for (int e = graph_.starts[v]; e < graph_.starts[v + 1]; ++e) visit(graph_.neighbours[e]);
  }

 private:
  bool is_cut(int v, int e) const { return sides_[v] != sides_[graph_.neighbours[e]]; }

  const WeightedGraph& graph_;
  Sides& sides_;
  std::vector<int> outside_;  // weight of each node's edges to the other side
  std::vector<int> inside_;
  int value_ = 0;
};

}  // namespace

EdgeCut improved_cut(const WeightedGraph& graph, Sides sides) {
  constexpr int kPatience = 20;
  CutEdges cut(graph, sides);
  Improvement improvement(cut, kPatience);
  improvement.run(1);
  const CutScore score = improvement.score();
  return {score, std::move(sides)};
}

}  // namespace lapwing::dissection
