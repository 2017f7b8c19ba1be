#include "lapwing/laplacian/system_pattern.h"

#include <cmath>
#include <utility>

#include "lapwing/base/cancellation.h"
#include "lapwing/solve/dissection/mesh_dissection.h"
#include "lapwing/solve/ordering.h"

namespace lapwing {
namespace {

// Returns true if nested dissection pays for M'M of `n` unknowns, given the `operations` for L'L in
// the minimum degree order. On surfaces, nested dissection needs about 84 n^1.5 for L'L. M'M takes
// 27 times as many. The search takes as long as kSearch operations per unknown.
bool is_worth_dissecting(double n, double operations) {
  constexpr double kOfDissection = 84.0;
  constexpr double kSearch = 250'000.0;
  return 27.0 * (operations - kOfDissection * n * std::sqrt(n)) > kSearch * n;
}

}  // namespace

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

const std::vector<int>& SystemPattern::order() const {
  ordering_([&] {
    if (blocks().size() > kMinimumDegreeLimit) {
      order_ = dissection_order(coupling_);
      return;
    }
    MinimumDegreeOrder found = minimum_degree_order(blocks());
    operations_ = found.operations;
    order_ = std::move(found.order);
  });
  return order_;
}

const std::vector<int>& SystemPattern::factorization_order() const {
  order();
  thorough_ordering_([&] {
    if (is_worth_dissecting(static_cast<double>(blocks().size()), operations_)) {
      thorough_order_ = dissection_order(coupling_);
    }
    coupling_ = {};
  });
  return thorough_order_.empty() ? order_ : thorough_order_;
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
