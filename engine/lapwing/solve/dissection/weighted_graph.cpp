#include "lapwing/solve/dissection/weighted_graph.h"

#include <numeric>
#include <utility>

#include "lapwing/base/cancellation.h"

namespace lapwing::dissection {
namespace {

constexpr int kNone = -1;
// Target size of a group. Larger groups lead to fewer levels and rougher borders.
constexpr int kGroup = 4;
// A node whose neighbours are all in groups joins one of these groups. Groups grow to at most this
// size.
constexpr int kLargestGroup = 6;

class Grouping {
 public:
  Grouping(const WeightedGraph& fine, int most_weight, std::vector<int>& group_of)
      : fine_(fine), most_weight_(most_weight), group_of_(group_of) {}

  void run(std::size_t variant) {
    group_of_.assign(static_cast<std::size_t>(fine_.size()), kNone);
    weights.reserve(group_of_.size());
    sizes_.reserve(group_of_.size());
    CancelCheck check;
    const int n = fine_.size();
    const int start = static_cast<int>((variant / 2 * 40503U) % static_cast<std::size_t>(n));
    for (int k = 0; k < n; ++k) {
      const int at = (start + k) % n;
      const int v = variant % 2 == 0 ? at : n - 1 - at;
      check();
      if (group_of_[v] == kNone && !join_a_group(v)) begin_group(v);
    }
  }

  /// Weight of each group.
  std::vector<int> weights;

 private:
  // Creates a group of `v` and those neighbours without a group that have the heaviest edges to
  // `v`.
  void begin_group(int v) {
    const int group = static_cast<int>(weights.size());
    group_of_[v] = group;
    weights.push_back(fine_.weights[v]);
    sizes_.push_back(1);
    while (sizes_[group] < kGroup) {
      int best = kNone;
      int heaviest = 0;
      for (int e = fine_.starts[v]; e < fine_.starts[v + 1]; ++e) {
        const int u = fine_.neighbours[e];
        if (group_of_[u] != kNone || fine_.edge_weights[e] <= heaviest) continue;
        if (weights[group] + fine_.weights[u] > most_weight_) continue;
        best = u;
        heaviest = fine_.edge_weights[e];
      }
      if (best == kNone) return;
      put(best, group);
    }
  }

  // Adds `v` to the group of a neighbour. Returns false if a neighbour has no group, or if all
  // these groups are full.
  bool join_a_group(int v) {
    int best = kNone;
    int heaviest = 0;
    for (int e = fine_.starts[v]; e < fine_.starts[v + 1]; ++e) {
      const int group = group_of_[fine_.neighbours[e]];
      if (group == kNone) return false;
      if (sizes_[group] >= kLargestGroup || fine_.edge_weights[e] <= heaviest ||
          weights[group] + fine_.weights[v] > most_weight_) {
        continue;
      }
      best = group;
      heaviest = fine_.edge_weights[e];
    }
    if (best == kNone) return false;
    put(v, best);
    return true;
  }

  void put(int v, int group) {
    group_of_[v] = group;
    weights[group] += fine_.weights[v];
    ++sizes_[group];
  }

  const WeightedGraph& fine_;
  int most_weight_;
  std::vector<int>& group_of_;
  std::vector<int> sizes_;
};

}  // namespace

Groups group_neighbours(const WeightedGraph& graph, int most_weight, std::size_t variant) {
  Groups groups;
  Grouping grouping(graph, most_weight, groups.of_node);
  grouping.run(variant);
  const std::size_t count = grouping.weights.size();
  groups.starts.assign(count + 1, 0);
  for (const int g : groups.of_node) ++groups.starts[g + 1];
  std::partial_sum(groups.starts.begin(), groups.starts.end(), groups.starts.begin());
  groups.nodes.resize(groups.of_node.size());
  std::vector<int> next(groups.starts.begin(), groups.starts.end() - 1);
  for (int v = 0; v < graph.size(); ++v) groups.nodes[next[groups.of_node[v]]++] = v;
  return groups;
}

namespace {

// Builds the graph of groups row by row. `visit(g, v, other, e)` is called for every edge e from a
// node v of group g to another group. It returns the weight that e adds to the edge between the
// groups.
template <typename Visit>
WeightedGraph contract_rows(const WeightedGraph& fine, const Groups& groups, Visit visit) {
  WeightedGraph graph;
  graph.starts.reserve(groups.starts.size());
  graph.weights.reserve(groups.starts.size());
  graph.borders.reserve(groups.starts.size());
  // Allocated in full size, so that one index replaces the ends of two vectors. This takes 10% off
  // the time to find an order.
  std::vector<int> neighbours(fine.neighbours.size());
  std::vector<int> edge_weights(fine.neighbours.size());
  // Position of each group's edge in the current row.
  std::vector<int> place(groups.starts.size(), kNone);
  int end = 0;
  CancelCheck check;
  for (int g = 0; g < groups.size(); ++g) {
    check();
    const int row = end;
    int weight = 0;
    int border = 0;
    for (int m = groups.starts[g]; m < groups.starts[g + 1]; ++m) {
      const int v = groups.nodes[m];
      weight += fine.weights[v];
      border += fine.borders[v];
      for (int e = fine.starts[v]; e < fine.starts[v + 1]; ++e) {
        const int other = groups.of_node[fine.neighbours[e]];
        if (other == g) continue;
        const int added = visit(g, v, other, e);
        if (const int at = place[other]; at >= row) {
          edge_weights[at] += added;
          continue;
        }
        place[other] = end;
        neighbours[end] = other;
        edge_weights[end++] = added;
      }
    }
    graph.weights.push_back(weight);
    graph.borders.push_back(border);
    graph.starts.push_back(end);
  }
  graph.neighbours.assign(neighbours.begin(), neighbours.begin() + end);
  graph.edge_weights.assign(edge_weights.begin(), edge_weights.begin() + end);
  return graph;
}

}  // namespace

WeightedGraph contract(const WeightedGraph& fine, const Groups& groups) {
  return contract_rows(fine, groups, [&](int, int, int, int e) { return fine.edge_weights[e]; });
}

WeightedGraph contract_nodes(const WeightedGraph& fine, const Groups& groups) {
  // The last group for which each node was counted.
  std::vector<int> counted_for(fine.weights.size(), kNone);
  // The last node that was counted for each group.
  std::vector<int> last_node(groups.starts.size(), kNone);
  return contract_rows(fine, groups, [&](int g, int v, int other, int e) {
    const int u = fine.neighbours[e];
    int weight = 0;
    if (std::exchange(counted_for[u], g) != g) weight += fine.weights[u];
    if (std::exchange(last_node[other], v) != v) weight += fine.weights[v];
    return weight;
  });
}

}  // namespace lapwing::dissection
