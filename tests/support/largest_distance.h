#pragma once

#include <algorithm>

#include "lapwing/mesh/mesh.h"

namespace lapwing::test {

/// Returns the largest distance between the positions of a vertex in two poses.
inline double largest_distance(const Positions& a, const Positions& b) {
  double largest = 0.0;
  for (std::size_t v = 0; v < a.size(); ++v) largest = std::max(largest, (a[v] - b[v]).norm());
  return largest;
}

}  // namespace lapwing::test
