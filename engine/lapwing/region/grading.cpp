#include "lapwing/region/grading.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "lapwing/base/errors.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/region/geodesic.h"

namespace lapwing {

void split_by_field(const VertexSet& region, std::span<const double> field, std::size_t handle,
                    const std::string& where, VertexSet& full, std::vector<GradedVertex>& graded) {
  full.clear();
  double largest = 0.0;
  for (const Index v : region) {
    const double weight = field[v];
    largest = std::max(largest, weight);
    if (weight == 1.0) {
      full.push_back(v);
    } else if (weight > 0.0) {
      graded.push_back({v, handle, weight});
    }
  }
  if (!full.empty()) return;
  throw InputError(where + ": no vertex of the handle has weight 1, the largest is " +
                   std::to_string(largest) + "; divide the field by that");
}

std::vector<GradedVertex> falloff_of(const VertexSet& handle, const Transition& falloff,
                                     std::size_t number, std::span<const char> allowed,
                                     const Mesh& mesh) {
  std::vector<GradedVertex> graded;
  if (!(falloff.width > 0.0)) return graded;
  const std::vector<double> distances =
      geodesic_distances(mesh.topology(), mesh.positions, handle, falloff.width, allowed);
  for (std::size_t v = 0; v < distances.size(); ++v) {
    if (!(distances[v] > 0.0)) continue;
    const double weight = 1.0 - fade(falloff, distances[v]);
    if (weight > 0.0 && weight < 1.0) graded.push_back({static_cast<Index>(v), number, weight});
  }
  return graded;
}

std::vector<GradedVertex> without_shared(std::vector<GradedVertex> graded) {
  std::sort(graded.begin(), graded.end(), [](const GradedVertex& a, const GradedVertex& b) {
    return std::tuple(a.vertex, -a.weight, a.handle) < std::tuple(b.vertex, -b.weight, b.handle);
  });
  const auto last = std::unique(
      graded.begin(), graded.end(),
      [](const GradedVertex& a, const GradedVertex& b) { return a.vertex == b.vertex; });
  graded.erase(last, graded.end());
  return graded;
}

}  // namespace lapwing
