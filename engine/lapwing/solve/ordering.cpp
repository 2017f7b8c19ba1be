#include "lapwing/solve/ordering.h"

#include <array>
#include <limits>
#include <memory>
#include <numeric>
#include <string>
#include <utility>

#include <amd.h>
#include <metis.h>

#include "lapwing/base/errors.h"
#include "lapwing/solve/detached.h"

namespace lapwing {
namespace {

// Ordering fewer blocks takes less than 0.1 s, so it needs no separate thread.
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

// Calls AMD's inner routine, because the graph is symmetric and has no diagonal. amd_order would
// spend a sixth of its time to establish both.
std::vector<int> minimum_degree(const BlockGraph& graph, double* operations) {
  const std::size_t n = graph.starts.size() - 1;
  const std::size_t edges = graph.neighbours.size();
  const std::size_t room = edges + edges / 5 + n + 1;  // the size that AMD recommends
  if (room > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
    throw SolverError("the minimum degree ordering cannot index " + std::to_string(edges) +
                      " couplings of " + std::to_string(n) + " vertices; choose a smaller region");
  }
  std::vector<int> lists;
  lists.reserve(room);
  lists.assign(graph.neighbours.begin(), graph.neighbours.end());
  lists.resize(room);
  std::vector<int> starts(graph.starts.begin(), graph.starts.end() - 1);
  std::vector<int> lengths(n);
  for (std::size_t i = 0; i < n; ++i) lengths[i] = graph.starts[i + 1] - graph.starts[i];
  std::vector<int> order(n);
  std::array<std::vector<int>, 6> work;
  for (std::vector<int>& numbers : work) numbers.resize(n);
  std::array<double, AMD_INFO> info{};
  amd_2(static_cast<int>(n), starts.data(), lists.data(), lengths.data(), static_cast<int>(room),
        static_cast<int>(edges), work[0].data(), work[1].data(), order.data(), work[2].data(),
        work[3].data(), work[4].data(), work[5].data(), nullptr, info.data());
  // A column of c entries below the diagonal takes c divisions and c (c + 1) / 2 multiplications
  // with subtractions. Its term of the sum below is (c + 1)^2.
  if (operations != nullptr) {
    *operations = static_cast<double>(n) + info[AMD_NDIV] + 2 * info[AMD_NMULTSUBS_LDL];
  }
  return order;
}

EliminationOrder minimum_degree_order(const BlockPattern& pattern) {
  const std::size_t n = pattern.size();
  BlockGraph graph = block_graph(pattern);
  if (graph.neighbours.empty()) return {identity_order(n), static_cast<double>(n)};
  // Shared ownership, because an abandoned thread outlives this call and still writes to it.
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

std::vector<int> scalar_order(std::span<const int> order, int block_size) {
  std::vector<int> scalar;
  scalar.reserve(order.size() * static_cast<std::size_t>(block_size));
  for (const int block : order) {
    for (int k = 0; k < block_size; ++k) scalar.push_back(block * block_size + k);
  }
  return scalar;
}

}  // namespace lapwing
