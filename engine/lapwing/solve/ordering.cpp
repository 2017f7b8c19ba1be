#include "lapwing/solve/ordering.h"

#include <memory>
#include <numeric>
#include <string>
#include <utility>

#include <metis.h>

#include "lapwing/base/errors.h"
#include "lapwing/solve/detached.h"
#include "lapwing/solve/minimum_degree.h"

namespace lapwing {
namespace {

// Fewer blocks are ordered within 0.1 s, which is not worth a thread.
constexpr std::size_t kQuickToOrder = 30'000;

static_assert(sizeof(idx_t) == sizeof(int), "METIS must be built with 32-bit indices");

template <typename Order>
std::vector<int> cancellable(std::size_t nodes, Order order) {
  if (nodes <= kQuickToOrder) return order();
  return run_detached(std::move(order));
}

std::vector<int> nested_dissection(BlockGraph graph) {
  auto n = static_cast<idx_t>(graph.starts.size() - 1);
  std::vector<int> order(static_cast<std::size_t>(n));
  std::vector<int> inverse(static_cast<std::size_t>(n));
  const int status = METIS_NodeND(&n, graph.starts.data(), graph.neighbours.data(), nullptr,
                                  nullptr, order.data(), inverse.data());
  if (status != METIS_OK) {
    throw SolverError("the nested dissection of " + std::to_string(n) +
                      " vertices failed (METIS status " + std::to_string(status) +
                      "), probably out of memory; choose a smaller region");
  }
  return order;
}

std::vector<int> identity_order(std::size_t n) {
  std::vector<int> order(n);
  std::iota(order.begin(), order.end(), 0);
  return order;
}

}  // namespace

MinimumDegreeOrder minimum_degree_order(const BlockPattern& pattern) {
  const std::size_t n = pattern.size();
  BlockGraph graph = block_graph(pattern);
  if (graph.neighbours.empty()) return {identity_order(n), static_cast<double>(n)};
  // Shared, because an abandoned thread outlives this call and still writes the number.
  const auto operations = std::make_shared<double>(0.0);
  std::vector<int> order = cancellable(n, [operations, graph = std::move(graph)] {
    return minimum_degree(graph, operations.get());
  });
  return {std::move(order), *operations};
}

std::vector<int> fill_reducing_order(const BlockPattern& pattern, Ordering ordering) {
  const std::size_t n = pattern.size();
  if (ordering == Ordering::minimum_degree ||
      (ordering == Ordering::automatic && n <= kMinimumDegreeLimit)) {
    return minimum_degree_order(pattern).order;
  }
  BlockGraph graph = block_graph(pattern);
  if (graph.neighbours.empty()) return identity_order(n);
  return cancellable(n, [graph = std::move(graph)] { return nested_dissection(graph); });
}

}  // namespace lapwing
