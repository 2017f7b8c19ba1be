#include "lapwing/mesh/extent.h"

#include <optional>
#include <sstream>

#include "lapwing/base/errors.h"

namespace lapwing {

double require_extent(std::span<const Index> vertices, std::span<const Eigen::Vector3d> positions,
                      const std::string& where) {
  std::optional<Bounds> bounds;
  for (const Index v : vertices) {
    const Eigen::Vector3d& p = positions[v];
    if (!p.allFinite()) continue;
    if (!bounds) bounds = {p, p};
    bounds->min = bounds->min.cwiseMin(p);
    bounds->max = bounds->max.cwiseMax(p);
  }
  if (!bounds) return 0.0;
  // The squared length of the diagonal would overflow long before.
  const double extent = (bounds->max - bounds->min).maxCoeff();
  if (extent == 0.0 || (extent >= kSmallestExtent && extent <= kLargestExtent)) return extent;
  std::ostringstream text;
  text << where << ": the vertices span " << extent << ", outside the supported range from "
       << kSmallestExtent << " to " << kLargestExtent << "; scale the mesh";
  throw InputError(text.str());
}

}  // namespace lapwing
