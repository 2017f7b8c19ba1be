#pragma once

#include <span>
#include <vector>

namespace lapwing::dissection {

/// An undirected graph with weights, in compressed rows. Each edge is stored in the rows of both
/// ends.
struct WeightedGraph {
  std::vector<int> starts{0};
  std::vector<int> neighbours;
  std::vector<int> edge_weights;  ///< per entry of `neighbours`; empty if not needed
  std::vector<int> weights;       ///< of the nodes
  /// Of the nodes: number of border unknowns, which do not count in the weight.
  std::vector<int> borders;

  int size() const { return static_cast<int>(weights.size()); }
};

/// The side of each node, 0 or 1.
using Sides = std::vector<unsigned char>;

/// Groups of neighbouring nodes.
struct Groups {
  std::vector<int> of_node;
  std::vector<int> starts{0};
  std::vector<int> nodes;  ///< group g is nodes[starts[g], starts[g+1])

  int size() const { return static_cast<int>(starts.size()) - 1; }
};

/// Groups about four nodes at a time along their heaviest edges. No group of several nodes weighs
/// more than `most_weight`. The nodes are visited in ascending or descending order from some node;
/// `variant` selects both. Takes linear time. Throws Cancelled.
Groups group_neighbours(const WeightedGraph& graph, int most_weight, std::size_t variant);

/// Returns the graph of groups. The weight of an edge is the sum of all edge weights between its
/// two groups.
WeightedGraph contract(const WeightedGraph& fine, const Groups& groups);

/// Like `contract`, but the weight of an edge is the size of a separator between its two groups:
/// the sum of the weights of all nodes in one group that have a neighbour in the other. Ignores the
/// edge weights of `fine`.
WeightedGraph contract_nodes(const WeightedGraph& fine, const Groups& groups);

}  // namespace lapwing::dissection
