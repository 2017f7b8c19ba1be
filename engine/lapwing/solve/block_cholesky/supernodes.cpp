#include "lapwing/solve/block_cholesky/supernodes.h"

#include <algorithm>
#include <numeric>

#include "lapwing/base/cancellation.h"

namespace lapwing::cholesky {
namespace {

// Supernodes during merging. The `owner` of a merged supernode is the supernode that absorbed it.
struct Merging {
  std::vector<int> starts;  // fundamental supernode s is columns [starts[s], starts[s+1])
  std::vector<int> parent;
  std::vector<int> pivots;
  std::vector<int> updates;
  std::vector<int> owner;
  std::vector<std::vector<int>> children;

  int size() const { return static_cast<int>(parent.size()); }
};

// Column j belongs to the supernode of column j - 1 if j - 1 is its only child and both have the
// same rows.
Merging fundamental_supernodes(const EliminationTree& tree) {
  const int n = static_cast<int>(tree.parent.size());
  std::vector<int> child_counts(n, 0);
  for (int j = 0; j < n; ++j) {
    if (tree.parent[j] >= 0) ++child_counts[tree.parent[j]];
  }
  Merging nodes;
  std::vector<int> node_of(n);
  for (int j = 0; j < n; ++j) {
    const bool continues = j > 0 && tree.parent[j - 1] == j && child_counts[j] == 1 &&
                           tree.counts[j - 1] == tree.counts[j] + 1;
    if (!continues) nodes.starts.push_back(j);
    node_of[j] = static_cast<int>(nodes.starts.size()) - 1;
  }
  const int count = static_cast<int>(nodes.starts.size());
  nodes.starts.push_back(n);
  nodes.children.resize(count);
  nodes.owner.resize(count);
  std::iota(nodes.owner.begin(), nodes.owner.end(), 0);
  for (int s = 0; s < count; ++s) {
    const int last = nodes.starts[s + 1] - 1;
    const int parent = tree.parent[last] < 0 ? -1 : node_of[tree.parent[last]];
    nodes.parent.push_back(parent);
    nodes.pivots.push_back(nodes.starts[s + 1] - nodes.starts[s]);
    nodes.updates.push_back(tree.counts[last] - 1);
    if (parent >= 0) nodes.children[parent].push_back(s);
  }
  return nodes;
}

// Tries to merge each child once. Children with the most rows come first because they add the
// fewest zeros; the children of a merged child follow. A single pass takes linear time even if a
// node has very many children.
void merge_children(Merging& nodes, int block_size) {
  const auto cost = [&](int pivots, int updates) {
    return front_cost(static_cast<double>(block_size) * pivots,
                      static_cast<double>(block_size) * updates);
  };
  std::vector<int> queue;
  CancelCheck check;
  for (int q = 0; q < nodes.size(); ++q) {
    check();
    queue = std::move(nodes.children[q]);
    std::sort(queue.begin(), queue.end(), [&](int a, int b) {
      return nodes.updates[a] != nodes.updates[b] ? nodes.updates[a] > nodes.updates[b] : a < b;
    });
    std::vector<int> kept;
    for (std::size_t i = 0; i < queue.size(); ++i) {
      const int c = queue[i];
      const double apart =
          cost(nodes.pivots[c], nodes.updates[c]) + cost(nodes.pivots[q], nodes.updates[q]);
      if (cost(nodes.pivots[c] + nodes.pivots[q], nodes.updates[q]) < apart) {
        nodes.pivots[q] += nodes.pivots[c];
        nodes.owner[c] = q;
        queue.insert(queue.end(), nodes.children[c].begin(), nodes.children[c].end());
        nodes.children[c].clear();
      } else {
        kept.push_back(c);
      }
    }
    nodes.children[q] = std::move(kept);
  }
}

// Returns the supernodes that remain after merging, with new numbers.
Supernodes collect(const Merging& nodes, int block_size) {
  std::vector<int> owner(nodes.size());
  std::vector<int> number(nodes.size(), -1);
  for (int s = nodes.size() - 1; s >= 0; --s) {
    owner[s] = nodes.owner[s] == s ? s : owner[nodes.owner[s]];
  }
  int count = 0;
  for (int s = 0; s < nodes.size(); ++s) {
    if (owner[s] == s) number[s] = count++;
  }
  Supernodes result;
  result.columns.resize(count);
  result.update_counts.resize(count);
  result.parent.assign(count, -1);
  result.children.resize(count);
  result.cost.resize(count);
  for (int s = 0; s < nodes.size(); ++s) {
    auto& columns = result.columns[number[owner[s]]];
    for (int j = nodes.starts[s]; j < nodes.starts[s + 1]; ++j) columns.push_back(j);
    if (owner[s] != s) continue;
    const int q = number[s];
    result.update_counts[q] = nodes.updates[s];
    result.cost[q] = front_cost(static_cast<double>(block_size) * nodes.pivots[s],
                                static_cast<double>(block_size) * nodes.updates[s]);
    if (nodes.parent[s] < 0) continue;
    result.parent[q] = number[owner[nodes.parent[s]]];
    result.children[result.parent[q]].push_back(q);
  }
  return result;
}

}  // namespace

double front_flops(double pivots, double updates) {
  return pivots * pivots * pivots / 3 + pivots * pivots * updates + pivots * updates * updates;
}

double front_cost(double pivots, double updates) {
  constexpr double kPerFront = 600.0;  // ns
  constexpr double kFlopsPerNs = 38.0;
  // In ns; each panel entry is cleared, filled, and read by the solves.
  constexpr double kPerPanelEntry = 0.25;
  constexpr double kPerUpdateEntry = 0.55;  // ns; entries are added to the parent
  return kPerFront + front_flops(pivots, updates) / kFlopsPerNs +
         kPerPanelEntry * pivots * (pivots / 2 + updates) + kPerUpdateEntry * updates * updates / 2;
}

Supernodes find_supernodes(const EliminationTree& tree, int block_size) {
  Merging nodes = fundamental_supernodes(tree);
  merge_children(nodes, block_size);
  return collect(nodes, block_size);
}

}  // namespace lapwing::cholesky
