#pragma once

#include <span>
#include <vector>

namespace lapwing::dissection {

/// An undirected graph with weights, in compressed rows. Both rows of an edge hold it.
struct WeightedGraph {
  std::vector<int> starts{0};
  std::vector<int> neighbours;
  std::vector<int> edge_weights;  ///< per entry of `neighbours`; empty if not needed
  std::vector<int> weights;       ///< of the nodes
  std::vector<int> borders;       ///< of the nodes: number of border unknowns, which have no weight

  int size() const { return static_cast<int>(weights.size()); }
};

/// The side of a cut, 0 or 1, per node.
using Sides = std::vector<unsigned char>;

/// Groups of neighbouring nodes.
struct Groups {
  std::vector<int> of_node;
  std::vector<int> starts{0};
  std::vector<int> nodes;  ///< group g is nodes[starts[g], starts[g+1])

  int size() const { return static_cast<int>(starts.size()) - 1; }
};

/// Groups about four nodes at a time along their heaviest edges. No group weighs more than
/// `most_weight` unless a single node does. `variant` selects the first node and the direction.
/// Linear time. Throws Cancelled.
Groups group_neighbours(const WeightedGraph& graph, int most_weight, std::size_t variant);

/// Returns the graph of groups. An edge weighs as much as all edges between its two groups.
WeightedGraph contract(const WeightedGraph& fine, const Groups& groups);

/// The same, but an edge weighs as much as the nodes of its two groups with a neighbour in the
/// other one, that is, a separator between them. Ignores the edge weights of `fine`.
WeightedGraph contract_nodes(const WeightedGraph& fine, const Groups& groups);

}  // namespace lapwing::dissection
