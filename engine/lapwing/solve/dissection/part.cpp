#include "lapwing/solve/dissection/part.h"

#include <algorithm>
#include <utility>

namespace lapwing::dissection {
namespace {

// Largest number of nodes in a group. The first cuts treat a group as one node.
constexpr int kNodesInGroup = 6;

class PartBuilder {
 public:
  // Reserves memory for this many nodes and edges.
  PartBuilder(std::size_t nodes, std::size_t edges) {
    for (auto* numbers : {&part_.groups.of_node, &part_.groups.nodes, &part_.nodes,
                          &part_.graph.weights, &part_.graph.borders}) {
      numbers->reserve(nodes);
    }
    part_.groups.starts.reserve(nodes + 1);
    part_.graph.starts.reserve(nodes + 1);
    part_.graph.neighbours.reserve(edges);
  }

  // Adds a node. Successive nodes with the same value of `group` form a group.
  void add(int node, int weight, int border, int group) {
    Groups& groups = part_.groups;
    if (std::exchange(last_group_, group) != group) groups.starts.push_back(groups.starts.back());
    groups.of_node.push_back(groups.size() - 1);
    groups.nodes.push_back(groups.starts.back()++);
    part_.nodes.push_back(node);
    part_.graph.weights.push_back(weight);
    part_.graph.borders.push_back(border);
    part_.unknowns += weight;
  }

  // Adds the edges of `node` in the graph `starts`, `neighbours` whose other end belongs to this
  // part. number[u] is the index of node u in this part, or -1. Must be called for all nodes in the
  // order of their indices.
  void connect(const std::vector<int>& starts, const std::vector<int>& neighbours, int node,
               const std::vector<int>& number) {
    WeightedGraph& graph = part_.graph;
    for (int e = starts[node]; e < starts[node + 1]; ++e) {
      if (const int u = number[neighbours[e]]; u >= 0) graph.neighbours.push_back(u);
    }
    graph.starts.push_back(static_cast<int>(graph.neighbours.size()));
  }

  Part& part() { return part_; }

 private:
  Part part_;
  int last_group_ = -1;
};

}  // namespace

Part whole_part(const CouplingGraph& graph) {
  WeightedGraph even;
  even.starts = graph.starts;
  even.neighbours = graph.neighbours;
  even.edge_weights.assign(graph.neighbours.size(), 1);
  even.weights.assign(static_cast<std::size_t>(graph.size()), 1);
  const Groups groups = group_neighbours(even, kNodesInGroup, 0);
  PartBuilder builder(even.weights.size(), even.neighbours.size());
  std::vector<int> number(even.weights.size());
  for (const int v : groups.nodes) {
    number[v] = builder.part().graph.size();
    builder.add(v, v < graph.unknowns ? 1 : 0, 0, groups.of_node[v]);
  }
  for (const int v : builder.part().nodes) {
    builder.connect(graph.starts, graph.neighbours, v, number);
  }
  return std::move(builder.part());
}

Part side_of(const Part& part, const ThickSeparator& separator, int side) {
  const WeightedGraph& graph = part.graph;
  const auto is_left = [&](int v) {
    return graph.weights[v] > 0 && separator.side(v) == side && !separator.contains(v);
  };
  PartBuilder builder(graph.weights.size(), graph.neighbours.size());
  std::vector<int> number(graph.weights.size(), -1);
  for (int v = 0; v < graph.size(); ++v) {
    if (separator.side(v) != side) continue;
    const bool left = is_left(v);
    bool is_needed = left;
    for (int e = graph.starts[v]; !is_needed && e < graph.starts[v + 1]; ++e) {
      is_needed = is_left(graph.neighbours[e]);
    }
    if (!is_needed) continue;
    number[v] = builder.part().graph.size();
    // A separator is two nodes thick. Its far layer is not in this part, so the nodes of the near
    // layer count twice.
    const int border = left ? 0 : std::max(2 * graph.weights[v], graph.borders[v]);
    builder.add(v, left ? 1 : 0, border, part.groups.of_node[v]);
  }
  for (int& node : builder.part().nodes) {
    builder.connect(graph.starts, graph.neighbours, node, number);
    node = part.nodes[node];
  }
  return std::move(builder.part());
}

}  // namespace lapwing::dissection
