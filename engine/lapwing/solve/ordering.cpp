#include "lapwing/solve/ordering.h"

#include <numeric>
#include <string>
#include <utility>

#include <amd.h>
#include <metis.h>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"
#include "lapwing/solve/abandonable.h"

namespace lapwing {
namespace {

// Fewer blocks are ordered within 0.1 s, and a thread would be a waste.
constexpr std::size_t kQuickToOrder = 30'000;

static_assert(sizeof(idx_t) == sizeof(int), "METIS must be built with 32-bit indices");

template <typename Order>
std::vector<int> cancellable(std::size_t nodes, Order order) {
  if (nodes <= kQuickToOrder) return order();
  return run_abandonable(std::move(order));
}

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

// `weights` per node, or none.
std::vector<int> nested_dissection(BlockGraph graph, std::vector<idx_t> weights = {}) {
  auto n = static_cast<idx_t>(graph.starts.size() - 1);
  std::vector<int> order(static_cast<std::size_t>(n));
  std::vector<int> inverse(static_cast<std::size_t>(n));
  const int status = METIS_NodeND(&n, graph.starts.data(), graph.neighbours.data(),
                                  weights.empty() ? nullptr : weights.data(), nullptr, order.data(),
                                  inverse.data());
  if (status != METIS_OK) {
    throw SolverError("the nested dissection failed (METIS status " + std::to_string(status) +
                      "); out of memory at " + std::to_string(n) + " vertices");
  }
  return order;
}

// Lists of blocks, cluster after cluster.
struct Clusters {
  std::vector<int> starts{0};
  std::vector<int> blocks;

  explicit Clusters(std::span<const Index> cluster_of) {
    for (const Index c : cluster_of) {
      if (c + 2 > starts.size()) starts.resize(c + 2, 0);
      ++starts[c + 1];
    }
    std::partial_sum(starts.begin(), starts.end(), starts.begin());
    blocks.resize(cluster_of.size());
    std::vector<int> next = starts;
    for (std::size_t b = 0; b < cluster_of.size(); ++b) {
      blocks[static_cast<std::size_t>(next[cluster_of[b]]++)] = static_cast<int>(b);
    }
  }
  std::size_t count() const { return starts.size() - 1; }
  std::span<const int> operator[](std::size_t c) const {
    return std::span(blocks).subspan(static_cast<std::size_t>(starts[c]),
                                     static_cast<std::size_t>(starts[c + 1] - starts[c]));
  }
};

// The graph of clusters: neighbours where any of their blocks are.
BlockGraph graph_of_clusters(const BlockGraph& graph, const Clusters& clusters,
                             std::span<const Index> cluster_of) {
  BlockGraph result;
  result.starts.assign(1, 0);
  std::vector<std::size_t> seen_from(clusters.count(), clusters.count());
  CancelCheck cancel_check;
  for (std::size_t c = 0; c < clusters.count(); ++c) {
    cancel_check();
    seen_from[c] = c;
    for (const int block : clusters[c]) {
      const auto b = static_cast<std::size_t>(block);
      for (int e = graph.starts[b]; e < graph.starts[b + 1]; ++e) {
        const int neighbour = graph.neighbours[static_cast<std::size_t>(e)];
        const Index d = cluster_of[static_cast<std::size_t>(neighbour)];
        if (std::exchange(seen_from[d], c) != c) result.neighbours.push_back(static_cast<int>(d));
      }
    }
    result.starts.push_back(static_cast<int>(result.neighbours.size()));
  }
  return result;
}

}  // namespace

std::vector<int> clustered_order(const BlockPattern& pattern, std::span<const Index> cluster_of) {
  const Clusters clusters(cluster_of);
  BlockGraph graph = graph_of_clusters(block_graph(pattern), clusters, cluster_of);
  if (graph.neighbours.empty()) return clusters.blocks;
  std::vector<idx_t> weights;
  for (std::size_t c = 0; c < clusters.count(); ++c) {
    weights.push_back(static_cast<idx_t>(clusters[c].size()));
  }
  std::vector<int> order;
  order.reserve(cluster_of.size());
  const auto dissect = [graph = std::move(graph), weights = std::move(weights)] {
    return nested_dissection(graph, weights);
  };
  for (const int c : cancellable(clusters.count(), dissect)) {
    const auto blocks = clusters[static_cast<std::size_t>(c)];
    order.insert(order.end(), blocks.begin(), blocks.end());
  }
  return order;
}

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
  return cancellable(n, [amd, graph = std::move(graph)] {
    return amd ? minimum_degree(graph) : nested_dissection(graph);
  });
}

}  // namespace lapwing
