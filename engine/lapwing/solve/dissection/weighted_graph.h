#pragma once

#include <span>
#include <vector>

namespace lapwing::dissection {

/// An undirected graph with weights, in compressed rows: every edge stands in both of its rows.
struct WeightedGraph {
  std::vector<int> starts{0};
  std::vector<int> neighbours;
  std::vector<int> edge_weights;  ///< beside `neighbours`; empty where nobody asks for them
  std::vector<int> weights;       ///< of the nodes
  std::vector<int> borders;       ///< of the nodes: how many unknowns of a border, without weight

  int size() const { return static_cast<int>(weights.size()); }
};

/// Groups of neighbouring nodes.
struct Groups {
  std::vector<int> of_node;
  std::vector<int> starts{0};
  std::vector<int> nodes;  ///< group g is nodes[starts[g], starts[g+1])

  int size() const { return static_cast<int>(starts.size()) - 1; }
};

/// Groups nodes by four or so along their heaviest edges; no group weighs more than `most_weight`
/// unless a single node does. `variant` numbers different ways to begin. Linear time; throws
/// Cancelled.
Groups group_neighbours(const WeightedGraph& graph, int most_weight, std::size_t variant);

/// The graph of groups: an edge weighs as much as all edges between its two groups.
WeightedGraph contract(const WeightedGraph& fine, const Groups& groups);

/// The same, but an edge weighs as much as the nodes of its two groups that have a neighbour in the
/// other one: what a separator between them would hold. Edge weights of `fine` are not used.
WeightedGraph contract_nodes(const WeightedGraph& fine, const Groups& groups);

}  // namespace lapwing::dissection
