#include "lapwing/settle/moving_part.h"

#include <algorithm>

namespace lapwing {
namespace {

constexpr double kShareOfLargest = 0.2;
// A part may be this share of the unknowns, and so many: what it costs grows with every one.
constexpr double kLargestShare = 0.2;
constexpr std::size_t kLargestPart = 12000;
constexpr int kRingsAround = 3;

// Rows of the rings that are unknowns.
std::vector<char> unknown_rows(const RegionRings& rings) {
  std::vector<char> is_unknown(rings.vertices.size(), 0);
  for (const Index row : rings.unknown_rows) is_unknown[row] = 1;
  return is_unknown;
}

// Adds the unknowns of the next `count` rings around `rows`.
void grow(std::vector<Index>& rows, const RegionRings& rings, int count) {
  std::vector<char> may_come = unknown_rows(rings);
  for (const Index row : rows) may_come[row] = 0;
  std::size_t begin = 0;
  for (int ring = 0; ring < count; ++ring) {
    const std::size_t end = rows.size();
    for (; begin < end; ++begin) {
      const Index row = rows[begin];
      for (Index e = rings.starts[row]; e < rings.starts[row + 1]; ++e) {
        const Index j = rings.neighbours[e];
        if (may_come[j] == 0) continue;
        may_come[j] = 0;
        rows.push_back(j);
      }
    }
  }
}

}  // namespace

std::vector<Index> moving_part(const RegionRings& rings, std::span<const double> step,
                               double largest) {
  const std::size_t n = rings.unknown_rows.size();
  const double least = kShareOfLargest * kShareOfLargest * largest * largest;
  const auto moves = [&](std::size_t k) {
    const double x = step[k];
    const double y = step[n + k];
    const double z = step[2 * n + k];
    return x * x + y * y + z * z > least;
  };
  std::size_t count = 0;
  for (std::size_t k = 0; k < n; ++k) count += moves(k) ? 1 : 0;
  if (count > kLargestPart || static_cast<double>(count) > kLargestShare * static_cast<double>(n)) {
    return {};
  }
  std::vector<Index> part;
  for (std::size_t k = 0; k < n; ++k) {
    if (moves(k)) part.push_back(rings.unknown_rows[k]);
  }
  grow(part, rings, kRingsAround);
  for (Index& row : part) row = rings.vertices[row];
  std::sort(part.begin(), part.end());
  return part;
}

}  // namespace lapwing
