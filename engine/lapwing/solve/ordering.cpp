#include "lapwing/solve/ordering.h"

#include <numeric>
#include <string>

#include <amd.h>
#include <metis.h>

#include "lapwing/base/errors.h"

namespace lapwing {
namespace {

static_assert(sizeof(idx_t) == sizeof(int), "METIS must be built with 32-bit indices");

std::vector<int> minimum_degree(const BlockGraph& graph) {
  const int n = static_cast<int>(graph.starts.size()) - 1;
  std::vector<int> order(static_cast<std::size_t>(n));
  const int status =
      amd_order(n, graph.starts.data(), graph.neighbours.data(), order.data(), nullptr, nullptr);
  if (status != AMD_OK && status != AMD_OK_BUT_JUMBLED) {
    throw SolverError("the minimum degree ordering failed (AMD status " + std::to_string(status) +
                      "); out of memory at " + std::to_string(n) + " vertices");
  }
  return order;
}

std::vector<int> nested_dissection(BlockGraph graph) {
  auto n = static_cast<idx_t>(graph.starts.size() - 1);
  std::vector<int> order(static_cast<std::size_t>(n));
  std::vector<int> inverse(static_cast<std::size_t>(n));
  const int status = METIS_NodeND(&n, graph.starts.data(), graph.neighbours.data(), nullptr,
                                  nullptr, order.data(), inverse.data());
  if (status != METIS_OK) {
    throw SolverError("the nested dissection failed (METIS status " + std::to_string(status) +
                      "); out of memory at " + std::to_string(n) + " vertices");
  }
  return order;
}

}  // namespace

std::vector<int> fill_reducing_order(const BlockPattern& pattern, Ordering ordering) {
  const std::size_t n = pattern.size();
  BlockGraph graph = block_graph(pattern);
  if (graph.neighbours.empty()) {
    std::vector<int> order(n);
    std::iota(order.begin(), order.end(), 0);
    return order;
  }
  const bool amd = ordering == Ordering::minimum_degree ||
                   (ordering == Ordering::automatic && n <= kMinimumDegreeLimit);
  return amd ? minimum_degree(graph) : nested_dissection(std::move(graph));
}

}  // namespace lapwing
