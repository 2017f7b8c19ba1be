#include "lapwing/laplacian/weights.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace lapwing {
namespace {

using Eigen::Vector3d;

void set_uniform(std::span<double> row) {
  std::fill(row.begin(), row.end(), 1.0 / static_cast<double>(row.size()));
}

// Cotangent of the angle at `apex`; not finite for a triangle without area.
double cotangent(const Vector3d& apex, const Vector3d& a, const Vector3d& b) {
  const Vector3d u = a - apex;
  const Vector3d v = b - apex;
  return u.dot(v) / u.cross(v).norm();
}

// Adds the cotangents opposite to the edges i-j and i-k of one triangle to row i.
void add_triangle(const Triangle& t, Index i, std::span<const Vector3d> positions,
                  std::span<const Index> ring, std::span<double> row) {
  const std::size_t corner = t[0] == i ? 0 : t[1] == i ? 1 : 2;
  const Index j = t[(corner + 1) % 3];
  const Index k = t[(corner + 2) % 3];
  const auto add = [&](Index end, Index apex) {
    const double c = cotangent(positions[apex], positions[i], positions[end]);
    const auto at = std::lower_bound(ring.begin(), ring.end(), end) - ring.begin();
    if (std::isfinite(c)) row[static_cast<std::size_t>(at)] += c;
  };
  add(j, k);
  add(k, j);
}

void make_positive_and_normalize(std::span<double> row) {
  double mean = 0.0;
  for (const double w : row) mean += std::abs(w);
  mean /= static_cast<double>(row.size());
  if (!(mean > 0.0) || !std::isfinite(mean)) {
    set_uniform(row);
    return;
  }
  double sum = 0.0;
  for (double& w : row) sum += w = std::max(w, kSmallestCotangentShare * mean);
  for (double& w : row) w /= sum;
}

}  // namespace

std::vector<double> laplacian_weights(const Topology& topology, std::span<const Vector3d> positions,
                                      LaplacianWeights scheme) {
  const Adjacency& rings = topology.rings;
  std::vector<double> weights(rings.values.size(), 0.0);
  for (std::size_t i = 0; i < rings.row_count(); ++i) {
    const std::span row(weights.data() + rings.starts[i], rings.size(i));
    if (row.empty()) continue;
    if (scheme == LaplacianWeights::uniform) {
      set_uniform(row);
      continue;
    }
    for (const Index t : topology.vertex_triangles[i]) {
      add_triangle(topology.triangles[t], static_cast<Index>(i), positions, rings[i], row);
    }
    make_positive_and_normalize(row);
  }
  return weights;
}

}  // namespace lapwing
