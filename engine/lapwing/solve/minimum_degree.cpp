#include "lapwing/solve/minimum_degree.h"

#include <array>
#include <limits>
#include <string>

#include <amd.h>

#include "lapwing/base/errors.h"

namespace lapwing {

// Calls AMD's inner routine, because the graph is symmetric and has no diagonal. amd_order spends a
// sixth of its time to ensure that.
std::vector<int> minimum_degree(const BlockGraph& graph, double* operations) {
  const std::size_t n = graph.starts.size() - 1;
  const std::size_t edges = graph.neighbours.size();
  const std::size_t room = edges + edges / 5 + n + 1;  // as AMD advises
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

}  // namespace lapwing
