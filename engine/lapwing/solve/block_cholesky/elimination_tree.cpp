#include "lapwing/solve/block_cholesky/elimination_tree.h"

#include <numeric>
#include <utility>

#include "lapwing/base/cancellation.h"

namespace lapwing::cholesky {
namespace {

std::vector<int> inverse_of(std::span<const int> order) {
  std::vector<int> inverse(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) inverse[order[i]] = static_cast<int>(i);
  return inverse;
}

// Calls visit(neighbour) with the neighbours of node j in the tree's numbering.
template <typename Visit>
void for_each_neighbour(const BlockGraph& graph, const EliminationTree& tree, int j, Visit visit) {
  const int old = tree.order[j];
  for (int e = graph.starts[old]; e < graph.starts[old + 1]; ++e) {
    visit(tree.inverse[graph.neighbours[e]]);
  }
}

std::vector<int> parents_of(const BlockGraph& graph, const EliminationTree& tree) {
  const int n = static_cast<int>(tree.order.size());
  std::vector<int> parent(n, -1);
  std::vector<int> ancestor(n, -1);  // shortcut towards the root of the tree built so far
  CancelCheck check;
  for (int j = 0; j < n; ++j) {
    check();
    for_each_neighbour(graph, tree, j, [&](int k) {
      while (k != -1 && k < j) {
        const int next = std::exchange(ancestor[k], j);
        if (next == -1) parent[k] = j;
        k = next;
      }
    });
  }
  return parent;
}

// The postorder of a forest, children in ascending order.
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

void renumber(EliminationTree& tree, const std::vector<int>& postorder) {
  const std::vector<int> place = inverse_of(postorder);
  std::vector<int> order(postorder.size());
  std::vector<int> parent(postorder.size());
  for (std::size_t i = 0; i < postorder.size(); ++i) {
    order[i] = tree.order[postorder[i]];
    const int old_parent = tree.parent[postorder[i]];
    parent[i] = old_parent < 0 ? -1 : place[old_parent];
  }
  tree.order = std::move(order);
  tree.parent = std::move(parent);
  tree.inverse = inverse_of(tree.order);
}

// Root of the set of `node`, with path compression.
int find_root(std::vector<int>& ancestor, int node) {
  int root = node;
  while (root != ancestor[root]) root = ancestor[root];
  while (node != root) node = std::exchange(ancestor[node], root);
  return root;
}

// Row i of the factor is a subtree of the elimination tree. Its leaves add one to the counts below
// the root, the meeting points of neighbouring leaves take one back.
std::vector<int> column_counts(const BlockGraph& graph, const EliminationTree& tree) {
  const int n = static_cast<int>(tree.order.size());
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
    for_each_neighbour(graph, tree, j, [&](int i) {
      if (i <= j || first[j] <= latest_first[i]) return;
      latest_first[i] = first[j];
      ++counts[j];
      const int leaf = std::exchange(latest_leaf[i], j);
      if (leaf != -1) --counts[find_root(ancestor, leaf)];
    });
    if (parent != -1) ancestor[j] = parent;
  }
  for (int j = 0; j < n; ++j) {
    if (tree.parent[j] != -1) counts[tree.parent[j]] += counts[j];
  }
  return counts;
}

}  // namespace

EliminationTree build_elimination_tree(const BlockGraph& graph, std::span<const int> order) {
  EliminationTree tree;
  tree.order.assign(order.begin(), order.end());
  tree.inverse = inverse_of(order);
  tree.parent = parents_of(graph, tree);
  renumber(tree, postorder_of(tree.parent));
  tree.counts = column_counts(graph, tree);
  return tree;
}

}  // namespace lapwing::cholesky
