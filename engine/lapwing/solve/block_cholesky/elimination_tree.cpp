#include "lapwing/solve/block_cholesky/elimination_tree.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"

namespace lapwing::cholesky {
namespace {

// Calls visit(first, later, block) for every off-diagonal block.
template <typename Visit>
void for_each_block(const BlockPattern& pattern, const std::vector<int>& places, Visit visit) {
  CancelCheck check;
  for (std::size_t c = 0; c < pattern.size(); ++c) {
    check();
    const int column = places[c];
    for (std::size_t e = pattern.starts[c] + 1; e < pattern.starts[c + 1]; ++e) {
      const int row = places[pattern.rows[e]];
      visit(std::min(row, column), std::max(row, column), static_cast<int>(e));
    }
  }
}

std::vector<int> inverse_of(const std::vector<int>& order) {
  std::vector<int> inverse(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) inverse[order[i]] = static_cast<int>(i);
  return inverse;
}

// For each column, the columns that are coupled with it and eliminated before it.
struct EarlierColumns {
  std::vector<int> starts;
  std::vector<int> columns;
};

EarlierColumns earlier_columns(const EliminationGraph& graph) {
  EarlierColumns earlier;
  earlier.starts.assign(graph.starts.size(), 0);
  for (const int k : graph.later) ++earlier.starts[k + 1];
  for (int j = 0; j < graph.size(); ++j) earlier.starts[j + 1] += earlier.starts[j];
  earlier.columns.resize(graph.later.size());
  std::vector<int> next(earlier.starts.begin(), earlier.starts.end() - 1);
  for (int j = 0; j < graph.size(); ++j) {
    for (int e = graph.starts[j]; e < graph.starts[j + 1]; ++e) {
      earlier.columns[next[graph.later[e]]++] = j;
    }
  }
  return earlier;
}

std::vector<int> parents_of(const EliminationGraph& graph) {
  const EarlierColumns earlier = earlier_columns(graph);
  std::vector<int> parent(graph.places.size(), -1);
  // An ancestor in the tree built so far, often its root.
  std::vector<int> ancestor(graph.places.size(), -1);
  CancelCheck check;
  for (int j = 0; j < graph.size(); ++j) {
    check();
    for (int e = earlier.starts[j]; e < earlier.starts[j + 1]; ++e) {
      for (int k = earlier.columns[e]; k != -1 && k != j;) {
        const int next = std::exchange(ancestor[k], j);
        if (next == -1) parent[k] = j;
        k = next;
      }
    }
  }
  return parent;
}

// Returns the postorder of a forest, children in ascending order.
std::vector<int> postorder_of(const std::vector<int>& parent) {
  const int n = static_cast<int>(parent.size());
  std::vector<int> first_child(n, -1);
  std::vector<int> sibling(n, -1);
  for (int j = n - 1; j >= 0; --j) {
    if (parent[j] >= 0) sibling[j] = std::exchange(first_child[parent[j]], j);
  }
  std::vector<int> postorder;
  postorder.reserve(n);
  std::vector<int> path;
  for (int root = 0; root < n; ++root) {
    if (parent[root] >= 0) continue;
    path.push_back(root);
    while (!path.empty()) {
      const int node = path.back();
      const int child = first_child[node];
      if (child >= 0) {
        first_child[node] = sibling[child];
        path.push_back(child);
      } else {
        path.pop_back();
        postorder.push_back(node);
      }
    }
  }
  return postorder;
}

// Returns the root of the disjoint set that contains `node`, and compresses the path to the root.
int find_root(std::vector<int>& ancestor, int node) {
  int root = node;
  while (root != ancestor[root]) root = ancestor[root];
  while (node != root) node = std::exchange(ancestor[node], root);
  return root;
}

// The nonzero columns in row i of the factor form a subtree of the elimination tree. Each leaf of
// the subtree adds 1, and the least common ancestor of two consecutive leaves subtracts 1. The
// count of a column is the sum over the column and its descendants.
std::vector<int> column_counts(const EliminationGraph& graph, const EliminationTree& tree,
                               const std::vector<int>& node_of_column) {
  const int n = graph.size();
  std::vector<int> first(n, -1);  // first descendant
  std::vector<int> counts(n, 0);
  for (int j = 0; j < n; ++j) {
    if (first[j] == -1) counts[j] = 1;  // a leaf of the tree
    for (int k = j; k != -1 && first[k] == -1; k = tree.parent[k]) first[k] = j;
  }
  std::vector<int> latest_first(n, -1);
  std::vector<int> latest_leaf(n, -1);
  std::vector<int> ancestor(n);
  std::iota(ancestor.begin(), ancestor.end(), 0);
  CancelCheck check;
  for (int j = 0; j < n; ++j) {
    check();
    const int parent = tree.parent[j];
    if (parent != -1) --counts[parent];
    const int column = tree.columns[j];
    for (int e = graph.starts[column]; e < graph.starts[column + 1]; ++e) {
      const int i = node_of_column[graph.later[e]];
      if (first[j] <= latest_first[i]) continue;
      latest_first[i] = first[j];
      ++counts[j];
      const int leaf = std::exchange(latest_leaf[i], j);
      if (leaf != -1) --counts[find_root(ancestor, leaf)];
    }
    if (parent != -1) ancestor[j] = parent;
  }
  for (int j = 0; j < n; ++j) {
    if (tree.parent[j] != -1) counts[tree.parent[j]] += counts[j];
  }
  return counts;
}

}  // namespace

EliminationGraph elimination_graph(const BlockPattern& pattern, std::span<const int> order) {
  if (pattern.rows.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
    throw SolverError("the system has " + std::to_string(pattern.rows.size()) +
                      " blocks, more than the factorization can index; choose a smaller region");
  }
  EliminationGraph graph;
  graph.places.resize(order.size());
  for (std::size_t j = 0; j < order.size(); ++j) graph.places[order[j]] = static_cast<int>(j);
  graph.starts.assign(order.size() + 1, 0);
  for_each_block(pattern, graph.places, [&](int first, int, int) { ++graph.starts[first + 1]; });
  for (std::size_t j = 0; j < order.size(); ++j) graph.starts[j + 1] += graph.starts[j];
  graph.later.resize(static_cast<std::size_t>(graph.starts.back()));
  graph.blocks.resize(graph.later.size());
  std::vector<int> next(graph.starts.begin(), graph.starts.end() - 1);
  for_each_block(pattern, graph.places, [&](int first, int later, int block) {
    const int at = next[first]++;
    graph.later[at] = later;
    graph.blocks[at] = block;
  });
  return graph;
}

EliminationTree build_elimination_tree(const EliminationGraph& graph) {
  const std::vector<int> parent = parents_of(graph);
  EliminationTree tree;
  tree.columns = postorder_of(parent);
  const std::vector<int> node_of_column = inverse_of(tree.columns);
  tree.parent.reserve(parent.size());
  for (const int column : tree.columns) {
    tree.parent.push_back(parent[column] < 0 ? -1 : node_of_column[parent[column]]);
  }
  tree.counts = column_counts(graph, tree, node_of_column);
  return tree;
}

}  // namespace lapwing::cholesky
