#include "lapwing/solve/dissection/bisection.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "lapwing/solve/dissection/moves.h"

namespace lapwing::dissection {
namespace {

// On so few nodes several cuts are tried.
constexpr int kSearched = 4000;
// So few are cut as they are.
constexpr int kCoarsest = 120;
// Nodes far apart, by the distances from which the coarsest graph is swept; fewer for small sets.
constexpr std::size_t kTips = 8;
constexpr std::size_t kFewTips = 4;
// Sweeps that are improved.
constexpr std::size_t kSweepsKept = 3;
constexpr int kPatience = 30;
constexpr int kPasses = 4;

// The edges between two sides.
class EdgeCut {
 public:
  EdgeCut(const WeightedGraph& graph, Sides& sides)
      : graph_(graph),
        sides_(sides),
        outside_(graph.weights.size()),
        inside_(graph.weights.size()) {
    for (int v = 0; v < graph.size(); ++v) {
      for (int e = graph.starts[v]; e < graph.starts[v + 1]; ++e) {
        (is_cut(v, e) ? outside_[v] : inside_[v]) += graph.edge_weights[e];
      }
      value_ += outside_[v];
    }
    value_ /= 2;
  }

  int size() const { return graph_.size(); }
  int weight(int v) const { return graph_.weights[v]; }
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
  std::vector<int> outside_;  // of each node's edges, those to the other side
  std::vector<int> inside_;
  int value_ = 0;
};

CutScore improve(const WeightedGraph& graph, Sides& sides) {
  EdgeCut cut(graph, sides);
  Improvement improvement(cut, kPatience);
  improvement.run(kPasses);
  return improvement.score();
}

// Steps from `from` to each node; nodes that cannot be reached are farthest of all.
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

// Distances from nodes far apart, which on a body are the tips of its limbs.
std::vector<std::vector<int>> distances_from_tips(const WeightedGraph& graph, std::size_t count) {
  const auto farthest = [](const std::vector<int>& distance) {
    return static_cast<int>(std::max_element(distance.begin(), distance.end()) - distance.begin());
  };
  std::vector<std::vector<int>> tips;
  std::vector<int> nearest = distances_from(graph, 0);
  while (tips.size() < count) {
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

struct Candidate {
  CutScore score;
  Sides sides;
};

// Cuts between nodes in the order of a key, and keeps the best few.
class Sweeps {
 public:
  Sweeps(const WeightedGraph& graph, std::size_t kept) : graph_(graph), kept_(kept) {
    for (const int weight : graph.weights) total_ += weight;
  }

  void sweep(const std::vector<int>& key) {
    sort_by(key);
    // What each place in the order adds to the cut before it.
    change_.assign(key.size() + 1, 0);
    for (int v = 0; v < graph_.size(); ++v) {
      for (int e = graph_.starts[v]; e < graph_.starts[v + 1]; ++e) {
        if (graph_.neighbours[e] > v) continue;
        const auto [first, second] = std::minmax(place_[v], place_[graph_.neighbours[e]]);
        change_[first] += graph_.edge_weights[e];
        change_[second] -= graph_.edge_weights[e];
      }
    }
    SideWeights weights;
    weights.of[0] = total_;
    CutScore best(weights, 0);
    std::size_t best_count = 0;
    int cut = 0;
    for (std::size_t k = 0; k < order_.size(); ++k) {
      cut += change_[k];
      weights.move(graph_.weights[order_[k]], 0);
      if (const CutScore score(weights, cut); score < best) {
        best = score;
        best_count = k + 1;
      }
    }
    keep(best, best_count);
  }

  std::vector<Candidate> best() { return std::move(best_); }

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

  void keep(const CutScore& score, std::size_t count) {
    if (best_.size() == kept_ && !(score < best_.back().score)) return;
    Sides sides(order_.size(), 0);
    for (std::size_t k = 0; k < count; ++k) sides[order_[k]] = 1;
    if (best_.size() == kept_) best_.pop_back();
    const auto after = std::find_if(best_.begin(), best_.end(),
                                    [&](const Candidate& c) { return score < c.score; });
    best_.insert(after, {score, std::move(sides)});
  }

  const WeightedGraph& graph_;
  std::size_t kept_;
  int total_ = 0;
  std::vector<int> counts_;
  std::vector<int> order_;
  std::vector<int> place_;
  std::vector<int> change_;
  std::vector<Candidate> best_;
};

Candidate cut_coarsest(const WeightedGraph& graph, std::size_t tips) {
  const auto distances = distances_from_tips(graph, tips);
  Sweeps sweeps(graph, kSweepsKept);
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
  std::vector<Candidate> candidates = sweeps.best();
  Candidate* best = nullptr;
  for (Candidate& candidate : candidates) {
    candidate.score = improve(graph, candidate.sides);
    if (best == nullptr || candidate.score < best->score) best = &candidate;
  }
  return std::move(*best);
}

// A graph as it becomes smaller, level by level.
class Levels {
 public:
  // `graph` must outlive it.
  explicit Levels(const WeightedGraph& graph) : finest_(graph) { levels_.reserve(kMostLevels); }

  // Until at most `size` nodes are left, or hardly any can be grouped.
  void coarsen(int size, int most_weight, unsigned variant) {
    while (coarsest().size() > size && levels_.size() < kMostLevels) {
      Groups groups = group_neighbours(coarsest(), most_weight, variant);
      if (10 * groups.size() > 9 * coarsest().size()) return;
      WeightedGraph graph = contract(coarsest(), groups);
      levels_.push_back({std::move(groups.of_node), std::move(graph)});
    }
  }

  const WeightedGraph& coarsest() const { return levels_.empty() ? finest_ : levels_.back().graph; }

  // The cut of the finest graph that one of the coarsest becomes, improved on every level above.
  Candidate refine(Candidate cut) {
    while (!levels_.empty()) {
      const std::vector<int> group_of = std::move(levels_.back().group_of);
      levels_.pop_back();
      Sides finer(group_of.size());
      for (std::size_t v = 0; v < finer.size(); ++v) finer[v] = cut.sides[group_of[v]];
      cut.sides = std::move(finer);
      cut.score = improve(coarsest(), cut.sides);
    }
    return cut;
  }

 private:
  static constexpr std::size_t kMostLevels = 40;

  struct Level {
    std::vector<int> group_of;  // of the nodes one level finer
    WeightedGraph graph;
  };
  const WeightedGraph& finest_;
  std::vector<Level> levels_;
};

}  // namespace

Sides bisect(const WeightedGraph& graph, unsigned attempts, unsigned variant) {
  const int total = std::accumulate(graph.weights.begin(), graph.weights.end(), 0);
  const int most_weight = std::max(1, 3 * total / (2 * kCoarsest));
  Levels levels(graph);
  levels.coarsen(kSearched, most_weight, variant);
  std::optional<Candidate> best;
  for (unsigned attempt = 0; attempt < attempts; ++attempt) {
    Levels below(levels.coarsest());
    below.coarsen(kCoarsest, most_weight, attempt + 8 * variant);
    Candidate cut = below.refine(cut_coarsest(below.coarsest(), attempts > 1 ? kTips : kFewTips));
    if (!best || cut.score < best->score) best = std::move(cut);
  }
  return levels.refine(std::move(*best)).sides;
}

}  // namespace lapwing::dissection
