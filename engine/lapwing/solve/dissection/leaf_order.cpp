#include "lapwing/solve/dissection/leaf_order.h"

#include <array>
#include <bit>
#include <cstdint>
#include <utility>

#include "lapwing/solve/ordering.h"

namespace lapwing::dissection {
namespace {

// A set of nodes of a leaf and its surroundings, as bits.
class NodeSet {
 public:
  static constexpr int kMost = 256;

  void add(int node) { words_[node / 64] |= std::uint64_t{1} << (node % 64U); }
  void remove(int node) { words_[node / 64] &= ~(std::uint64_t{1} << (node % 64U)); }
  void add(const NodeSet& other) {
    for (std::size_t w = 0; w < words_.size(); ++w) words_[w] |= other.words_[w];
  }
  int size() const {
    // Sums the bit counts of all words together, because std::popcount is a function call on CPUs
    // without a popcount instruction.
    constexpr std::uint64_t kPairs = 0x5555555555555555;
    constexpr std::uint64_t kFours = 0x3333333333333333;
    constexpr std::uint64_t kBytes = 0x0f0f0f0f0f0f0f0f;
    std::uint64_t by_byte = 0;
    for (std::uint64_t x : words_) {
      x -= (x >> 1U) & kPairs;
      x = (x & kFours) + ((x >> 2U) & kFours);
      by_byte += (x + (x >> 4U)) & kBytes;
    }
    return static_cast<int>(by_byte * 0x0101010101010101 >> 56U);
  }
  template <typename Visit>
  void for_each_below(int end, Visit visit) const {
    for (int w = 0; 64 * w < end; ++w) {
      for (std::uint64_t word = words_[w]; word != 0; word &= word - 1) {
        const int node = 64 * w + std::countr_zero(word);
        if (node >= end) return;
        visit(node);
      }
    }
  }

 private:
  std::array<std::uint64_t, kMost / 64> words_{};
};

// Largest leaf that is ordered with NodeSets. Surrounding unknowns beyond NodeSet::kMost nodes are
// ignored.
constexpr std::size_t kMostExact = 160;

template <typename Visit>
void for_coupled(const CouplingGraph& graph, int v, Visit visit) {
  for (int e = graph.starts[v]; e < graph.starts[v + 1]; ++e) {
    const int u = graph.neighbours[e];
    visit(u);
    for (int f = graph.starts[u]; f < graph.starts[u + 1]; ++f) visit(graph.neighbours[f]);
  }
}

// Orders a large leaf for which no good separator exists, such as a fan of thousands of triangles.
std::vector<int> large_leaf(const CouplingGraph& graph, std::span<const int> unknowns,
                            const std::vector<int>& place) {
  BlockGraph coupled;
  coupled.starts = {0};
  std::vector<int> seen_from(unknowns.size(), -1);
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    seen_from[i] = static_cast<int>(i);
    for_coupled(graph, unknowns[i], [&](int u) {
      const int k = place[u];
      if (k < 0 || std::exchange(seen_from[k], static_cast<int>(i)) == static_cast<int>(i)) return;
      coupled.neighbours.push_back(k);
    });
    coupled.starts.push_back(static_cast<int>(coupled.neighbours.size()));
  }
  return minimum_degree(coupled);
}

}  // namespace

LeafOrder::LeafOrder(const CouplingGraph& graph)
    : graph_(graph), place_(static_cast<std::size_t>(graph.size()), -1) {}

void LeafOrder::sort(std::span<int> unknowns) {
  const int n = static_cast<int>(unknowns.size());
  const std::vector<int> nodes(unknowns.begin(), unknowns.end());
  for (int i = 0; i < n; ++i) place_[nodes[i]] = i;
  if (nodes.size() > kMostExact) {
    const std::vector<int> order = large_leaf(graph_, nodes, place_);
    for (int i = 0; i < n; ++i) unknowns[i] = nodes[order[i]];
    for (const int v : nodes) place_[v] = -1;
    return;
  }
  std::array<NodeSet, kMostExact> coupled;
  std::array<int, kMostExact> degree;
  std::vector<int> around;
  int count = n;
  for (int i = 0; i < n; ++i) {
    for_coupled(graph_, nodes[i], [&](int u) {
      if (u >= graph_.unknowns) return;
      if (place_[u] < 0) {
        if (count == NodeSet::kMost) return;
        place_[u] = count++;
        around.push_back(u);
      }
      coupled[i].add(place_[u]);
    });
    coupled[i].remove(i);
    degree[i] = coupled[i].size();
  }
  for (const int v : nodes) place_[v] = -1;
  for (const int v : around) place_[v] = -1;
  std::vector<int> left(nodes.size());
  for (int i = 0; i < n; ++i) left[i] = i;
  for (int done = 0; done < n; ++done) {
    std::size_t at = 0;
    for (std::size_t k = 1; k < left.size(); ++k) {
      if (degree[left[k]] < degree[left[at]]) at = k;
    }
    const int v = left[at];
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(at));
    unknowns[done] = nodes[v];
    const NodeSet row = coupled[v];
    row.for_each_below(n, [&](int u) {
      coupled[u].add(row);
      coupled[u].remove(u);
      coupled[u].remove(v);
      degree[u] = coupled[u].size();
    });
  }
}

}  // namespace lapwing::dissection
