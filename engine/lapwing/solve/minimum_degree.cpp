#include "lapwing/solve/minimum_degree.h"

#include <array>
#include <string>

#include <amd.h>

#include "lapwing/base/errors.h"

namespace lapwing {

std::vector<int> minimum_degree(const BlockGraph& graph, double* operations) {
  const int n = static_cast<int>(graph.starts.size()) - 1;
  std::vector<int> order(static_cast<std::size_t>(n));
  std::array<double, AMD_INFO> info{};
  const int status = amd_order(n, graph.starts.data(), graph.neighbours.data(), order.data(),
                               nullptr, info.data());
  if (status != AMD_OK && status != AMD_OK_BUT_JUMBLED) {
    throw SolverError("the minimum degree ordering failed (AMD status " + std::to_string(status) +
                      "); out of memory at " + std::to_string(n) + " vertices");
  }
  // A column of c entries below the diagonal takes c divisions and c (c + 1) / 2 multiplications
  // with subtractions.
  if (operations != nullptr) *operations = n + info[AMD_NDIV] + 2 * info[AMD_NMULTSUBS_LDL];
  return order;
}

}  // namespace lapwing
