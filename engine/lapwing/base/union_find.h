#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace lapwing {

/// Disjoint sets of the numbers 0 .. count - 1. The representative of a set is its smallest member,
/// independent of the order of the unions. Near-linear in practice.
class UnionFind {
 public:
  explicit UnionFind(std::size_t count) : parents_(count) {
    std::iota(parents_.begin(), parents_.end(), std::uint32_t{0});
  }

  /// Returns the smallest member of the set of `x`.
  std::uint32_t find(std::uint32_t x) {
    while (parents_[x] != x) {
      parents_[x] = parents_[parents_[x]];
      x = parents_[x];
    }
    return x;
  }

  /// Merges the sets of `a` and `b`. Returns whether they were different.
  bool unite(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    if (a == b) return false;
    parents_[a < b ? b : a] = a < b ? a : b;
    return true;
  }

 private:
  std::vector<std::uint32_t> parents_;
};

}  // namespace lapwing
