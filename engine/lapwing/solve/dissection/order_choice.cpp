#include "lapwing/solve/dissection/order_choice.h"

#include <cmath>

namespace lapwing {

EliminationOrder quick_order(const BlockPattern& pattern, const CouplingGraph& coupling) {
  if (pattern.size() > kMinimumDegreeLimit) return {dissection_order(coupling)};
  return minimum_degree_order(pattern);
}

std::vector<int> thorough_order(const EliminationOrder& quick, const CouplingGraph& coupling) {
  // On surfaces, a factorization in nested dissection order needs about 84 n^1.5 operations in 1 x
  // 1 blocks, and 27 times as many in 3 x 3 blocks. Finding the order takes as much time as kSearch
  // operations per unknown.
  constexpr double kOfDissection = 84.0;
  constexpr double kSearch = 250'000.0;
  const auto n = static_cast<double>(quick.order.size());
  const double saved = 27.0 * (quick.operations - kOfDissection * n * std::sqrt(n));
  return saved > kSearch * n ? dissection_order(coupling) : std::vector<int>();
}

}  // namespace lapwing
