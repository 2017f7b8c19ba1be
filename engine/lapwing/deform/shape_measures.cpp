#include "lapwing/deform/shape_measures.h"

#include <algorithm>
#include <cmath>

#include "lapwing/laplacian/ring_fit.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

// |length' / length - 1| of an edge; below 0 for one without length.
double stretch_of(Index i, Index j, std::span<const Vector3d> rest,
                  std::span<const Vector3d> current) {
  const double was = (rest[i] - rest[j]).norm();
  return was > 0.0 ? std::abs((current[i] - current[j]).norm() / was - 1.0) : -1.0;
}

}  // namespace

double detail_error(std::span<const Index> rows, const Topology& topology,
                    std::span<const double> weights, std::span<const Vector3d> rest,
                    std::span<const Vector3d> current) {
  double off = 0.0;
  double size = 0.0;
  for (const Index i : rows) {
    const auto ring = topology.rings[i];
    const double* w = weights.data() + topology.rings.starts[i];
    Vector3d was = Vector3d::Zero();
    Vector3d is = Vector3d::Zero();
    for (std::size_t k = 0; k < ring.size(); ++k) {
      was += w[k] * (rest[i] - rest[ring[k]]);
      is += w[k] * (current[i] - current[ring[k]]);
    }
    off += (is - fit_rotation(i, ring, rest, current) * was).squaredNorm();
    size += was.squaredNorm();
  }
  return size > 0.0 ? std::sqrt(off / size) : 0.0;
}

double edge_stretch(std::span<const Index> rows, const Topology& topology,
                    std::span<const Vector3d> rest, std::span<const Vector3d> current) {
  double sum = 0.0;
  std::size_t count = 0;
  for (const Index i : rows) {
    for (const Index j : topology.rings[i]) {
      const double stretch = stretch_of(i, j, rest, current);
      if (stretch < 0.0) continue;
      sum += stretch * stretch;
      ++count;
    }
  }
  return count > 0 ? std::sqrt(sum / static_cast<double>(count)) : 0.0;
}

StretchedEdge most_stretched_edge(std::span<const Index> rows, const Topology& topology,
                                  std::span<const Vector3d> rest,
                                  std::span<const Vector3d> current) {
  StretchedEdge most;
  for (const Index i : rows) {
    for (const Index j : topology.rings[i]) {
      const double stretch = stretch_of(i, j, rest, current);
      if (stretch > most.stretch) most = {{std::min(i, j), std::max(i, j)}, stretch};
    }
  }
  return most;
}

}  // namespace lapwing
