#include "lapwing/laplacian/system_pattern.h"

#include "lapwing/base/cancellation.h"

namespace lapwing {
CouplingGraph coupling_graph(const Adjacency& rings, std::span<const Index> rows,
                             const Unknowns& unknowns) {
  std::vector<int> node_of(rings.row_count(), -1);
  std::vector<Index> vertices = unknowns.vertices;
  for (std::size_t u = 0; u < vertices.size(); ++u) node_of[vertices[u]] = static_cast<int>(u);
  for (const Index v : rows) {
    if (node_of[v] >= 0) continue;
    node_of[v] = static_cast<int>(vertices.size());
    vertices.push_back(v);
  }
  CouplingGraph graph;
  graph.unknowns = static_cast<int>(unknowns.size());
  graph.starts.reserve(vertices.size() + 1);
  CancelCheck check;
  for (const Index v : vertices) {
    check();
    for (const Index j : rings[v]) {
      if (node_of[j] >= 0) graph.neighbours.push_back(node_of[j]);
    }
    graph.starts.push_back(static_cast<int>(graph.neighbours.size()));
  }
  return graph;
}

SystemPattern::SystemPattern(const Topology& topology, std::span<const Index> roi,
                             const Unknowns& unknowns)
    : normal_(ring_blocks(topology.rings, roi), unknowns),
      coupling_(coupling_graph(topology.rings, roi, unknowns)) {}

const EliminationOrder& SystemPattern::quick() const {
  ordering_([&] { quick_ = quick_order(blocks(), coupling_); });
  return quick_;
}

const std::vector<int>& SystemPattern::factorization_order() const {
  quick();
  thorough_ordering_([&] {
    thorough_ = thorough_order(quick_, coupling_);
    coupling_ = {};
  });
  return thorough_.empty() ? quick_.order : thorough_;
}

std::shared_ptr<const SolverAnalysis> SystemPattern::analysis() const {
  const std::vector<int>& order = factorization_order();
  const std::scoped_lock lock(analyzing_);
  std::shared_ptr<const SolverAnalysis> analysis = analysis_.lock();
  if (analysis == nullptr) {
    const std::unique_ptr<BlockSolver> solver = make_solver();
    solver->analyze(blocks(), 3, order);
    analysis = solver->analysis();
    analysis_ = analysis;
  }
  return analysis;
}

bool SystemPattern::has_analysis() const {
  const std::scoped_lock lock(analyzing_);
  return !analysis_.expired();
}

}  // namespace lapwing
