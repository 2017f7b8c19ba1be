#include "lapwing/solve/dissection/sweeps.h"

#include <algorithm>
#include <numeric>
#include <optional>

namespace lapwing::dissection {
namespace {

// Number of nodes far apart that sweeps start from.
constexpr std::size_t kTips = 4;

// Returns the number of edges from `from` to each node, or the graph's size if there is no path.
std::vector<int> distances_from(const WeightedGraph& graph, int from) {
  std::vector<int> distance(graph.weights.size(), graph.size());
  std::vector<int> queue{from};
  queue.reserve(distance.size());
  distance[from] = 0;
  for (std::size_t next = 0; next < queue.size(); ++next) {
    const int v = queue[next];
    for (int e = graph.starts[v]; e < graph.starts[v + 1]; ++e) {
      const int u = graph.neighbours[e];
      if (distance[u] < graph.size()) continue;
      distance[u] = distance[v] + 1;
      queue.push_back(u);
    }
  }
  return distance;
}

std::vector<std::vector<int>> distances_from_tips(const WeightedGraph& graph) {
  const auto farthest = [](const std::vector<int>& distance) {
    return static_cast<int>(std::max_element(distance.begin(), distance.end()) - distance.begin());
  };
  std::vector<std::vector<int>> tips;
  std::vector<int> nearest = distances_from(graph, 0);
  while (tips.size() < kTips) {
    const int tip = farthest(nearest);
    if (!tips.empty() && nearest[tip] == 0) break;
    tips.push_back(distances_from(graph, tip));
    if (tips.size() == 1) {
      nearest = tips.back();
      continue;
    }
    for (std::size_t v = 0; v < nearest.size(); ++v) {
      nearest[v] = std::min(nearest[v], tips.back()[v]);
    }
  }
  return tips;
}

// Tries every cut between nodes in the order of a key, and keeps the best one.
class Sweeps {
 public:
  explicit Sweeps(const WeightedGraph& graph) : graph_(graph) {
    for (int v = 0; v < graph.size(); ++v) whole_.add(graph.weights[v], graph.borders[v], 0);
  }

  void sweep(const std::vector<int>& key) {
    sort_by(key);
    // How much each place in the order changes the cut before it.
    change_.assign(key.size() + 1, 0);
    for (int v = 0; v < graph_.size(); ++v) {
      for (int e = graph_.starts[v]; e < graph_.starts[v + 1]; ++e) {
        if (graph_.neighbours[e] > v) continue;
        const auto [first, second] = std::minmax(place_[v], place_[graph_.neighbours[e]]);
        change_[first] += graph_.edge_weights[e];
        change_[second] -= graph_.edge_weights[e];
      }
    }
    SideWeights weights = whole_;
    int cut = 0;
    std::optional<std::size_t> improved;
    for (std::size_t k = 0; k < order_.size(); ++k) {
      cut += change_[k];
      const int v = order_[k];
      weights.move(graph_.weights[v], graph_.borders[v], 0);
      // If the next node makes the cut smaller, this one is not worth a score.
      if (change_[k + 1] < 0) continue;
      if (const CutScore score(weights, cut); score < best_score_) {
        best_score_ = score;
        improved = k + 1;
      }
    }
    if (!improved) return;
    best_.assign(order_.size(), 0);
    for (std::size_t k = 0; k < *improved; ++k) best_[order_[k]] = 1;
  }

  const Sides& best() const { return best_; }

 private:
  void sort_by(const std::vector<int>& key) {
    const auto [least, most] = std::minmax_element(key.begin(), key.end());
    std::vector<int>& next = counts_;
    next.assign(static_cast<std::size_t>(*most - *least) + 2, 0);
    for (const int k : key) ++next[k - *least + 1];
    std::partial_sum(next.begin(), next.end(), next.begin());
    order_.resize(key.size());
    place_.resize(key.size());
    for (std::size_t v = 0; v < key.size(); ++v) {
      place_[v] = next[key[v] - *least]++;
      order_[place_[v]] = static_cast<int>(v);
    }
  }

  const WeightedGraph& graph_;
  SideWeights whole_;  // all nodes on one side
  std::vector<int> counts_;
  std::vector<int> order_;
  std::vector<int> place_;
  std::vector<int> change_;
  CutScore best_score_;
  Sides best_;
};

}  // namespace

EdgeCut best_sweep(const WeightedGraph& graph) {
  const auto distances = distances_from_tips(graph);
  Sweeps sweeps(graph);
  std::vector<int> difference(graph.weights.size());
  for (std::size_t a = 0; a < distances.size(); ++a) {
    sweeps.sweep(distances[a]);
    for (std::size_t b = 0; b < a; ++b) {
      for (std::size_t v = 0; v < difference.size(); ++v) {
        difference[v] = distances[a][v] - distances[b][v];
      }
      sweeps.sweep(difference);
    }
  }
  return improved_cut(graph, sweeps.best());
}

}  // namespace lapwing::dissection
