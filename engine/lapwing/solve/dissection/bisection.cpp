#include "lapwing/solve/dissection/bisection.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "lapwing/solve/dissection/moves.h"

namespace lapwing::dissection {
namespace {

// Number of nodes of the graph on which several cuts are tried.
constexpr int kSearched = 4000;
// Number of nodes of the graph that is cut by sweeps.
constexpr int kCoarsest = 60;

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

// Improves the cut of `graph` into `sides` by one pass of moves, and returns the improved cut.
EdgeCut improved_cut(const WeightedGraph& graph, Sides sides) {
  constexpr int kPatience = 20;
  CutEdges cut(graph, sides);
  Improvement improvement(cut, kPatience);
  improvement.run(1);
  const CutScore score = improvement.score();
  return {score, std::move(sides)};
}

// Number of start nodes of the sweeps, which are far apart.
constexpr std::size_t kTips = 4;

// Returns the number of edges on a shortest path from `from` to each node, or the graph's size if
// there is no path.
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

// Each sweep sorts the nodes by a key and evaluates the cuts between successive nodes. Stores the
// best cut of all sweeps.
class Sweeps {
 public:
  explicit Sweeps(const WeightedGraph& graph) : graph_(graph) {
    for (int v = 0; v < graph.size(); ++v) whole_.add(graph.weights[v], graph.borders[v], 0);
  }

  void sweep(const std::vector<int>& key) {
    sort_by(key);
    // change_[k] is the change of the cut weight when the node at position k changes sides.
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
      // If the next node reduces the cut weight, the cut before it is not scored.
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

// Returns a cut of a small graph. The keys of the sweeps are the distances from several nodes that
// are far apart, such as the tips of a body's limbs, and the differences of two such distances. The
// best cut of all sweeps is then improved.
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

}  // namespace

Bisection::Bisection(const WeightedGraph& graph)
    : graph_(graph),
      most_weight_(std::max(
          1, std::accumulate(graph.weights.begin(), graph.weights.end(), 0) / (2 * kCoarsest / 3))),
      levels_(coarsen(graph, kSearched, 0)) {}

EdgeCut Bisection::attempt(std::size_t number) const {
  const WeightedGraph& searched = levels_.empty() ? graph_ : levels_.back().graph;
  const std::vector<Level> levels = coarsen(searched, kCoarsest, number);
  return refine(best_sweep(levels.empty() ? searched : levels.back().graph), levels, searched);
}

Sides Bisection::refine(const EdgeCut& cut) const {
  return refine(cut, levels_, graph_).sides;
}

std::vector<Bisection::Level> Bisection::coarsen(const WeightedGraph& finest, int size,
                                                 std::size_t variant) const {
  constexpr std::size_t kMostLevels = 40;
  std::vector<Level> levels;
  levels.reserve(kMostLevels);
  while (levels.size() < kMostLevels) {
    const WeightedGraph& graph = levels.empty() ? finest : levels.back().graph;
    if (graph.size() <= size) break;
    Groups groups = group_neighbours(graph, most_weight_, variant);
    if (10 * groups.size() > 9 * graph.size()) break;
    WeightedGraph coarser = contract(graph, groups);
    levels.push_back({std::move(groups.of_node), std::move(coarser)});
  }
  return levels;
}

EdgeCut Bisection::refine(EdgeCut cut, const std::vector<Level>& levels,
                          const WeightedGraph& finest) {
  for (std::size_t level = levels.size(); level-- > 0;) {
    const std::vector<int>& group_of = levels[level].group_of;
    Sides finer(group_of.size());
    for (std::size_t v = 0; v < finer.size(); ++v) finer[v] = cut.sides[group_of[v]];
    cut = improved_cut(level == 0 ? finest : levels[level - 1].graph, std::move(finer));
  }
  return cut;
}

}  // namespace lapwing::dissection
