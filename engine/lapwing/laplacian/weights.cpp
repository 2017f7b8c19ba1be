#include "lapwing/laplacian/weights.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/Geometry>

#include "lapwing/base/parallel.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

void set_uniform(std::span<double> row) {
  std::fill(row.begin(), row.end(), 1.0 / static_cast<double>(row.size()));
}

// Returns the cotangent of the angle at `apex`, clamped to kLargestCotangent. A triangle without
// area gets one of the two limits, like an almost degenerate one. Returns NaN if `apex` coincides
// with `a` or `b`.
double cotangent(const Vector3d& apex, const Vector3d& a, const Vector3d& b) {
  const Vector3d u = a - apex;
  const Vector3d v = b - apex;
  const double c = u.dot(v) / u.cross(v).norm();
  return std::clamp(c, -kLargestCotangent, kLargestCotangent);
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
    if (!std::isnan(c)) row[static_cast<std::size_t>(at)] += c;
  };
  add(j, k);
  add(k, j);
}

// Sets row i to the sums of the cotangents opposite to its edges.
void set_cotangents(const Topology& topology, Index i, std::span<const Vector3d> positions,
                    std::span<double> row) {
  std::fill(row.begin(), row.end(), 0.0);
  for (const Index t : topology.vertex_triangles[i]) {
    add_triangle(topology.triangles[t], i, positions, topology.rings[i], row);
  }
}

// Raises small weights to kSmallestCotangentShare times the mean absolute weight. Returns false if
// the mean is 0 or not finite.
bool make_positive(std::span<double> weights) {
  double mean = 0.0;
  for (const double w : weights) mean += std::abs(w);
  mean /= static_cast<double>(weights.size());
  if (!(mean > 0.0) || !std::isfinite(mean)) return false;
  for (double& w : weights) w = std::max(w, kSmallestCotangentShare * mean);
  return true;
}

double sum_of(std::span<const double> row) {
  double sum = 0.0;
  for (const double w : row) sum += w;
  return sum;
}

std::vector<Index> all_rows(const Topology& topology) {
  std::vector<Index> all(topology.rings.row_count());
  std::iota(all.begin(), all.end(), Index{0});
  return all;
}

// Calls body(i, entries of row i) for each of `rows` that has entries.
template <typename Body>
void for_rows(const Topology& topology, std::span<const Index> rows, std::span<double> values,
              const Body& body) {
  constexpr std::size_t kRowsPerTask = 2048;
  const Adjacency& rings = topology.rings;
  parallel_for(rows.size(), kRowsPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const Index i = rows[k];
      const std::span row = values.subspan(rings.starts[i], rings.size(i));
      if (!row.empty()) body(i, row);
    }
  });
}

// Converts a row of cotangent sums to weights.
void make_weights(std::span<double> row) {
  if (!make_positive(row)) return set_uniform(row);
  const double sum = sum_of(row);
  for (double& w : row) w /= sum;
}

}  // namespace

std::vector<double> laplacian_weights(const Topology& topology, std::span<const Vector3d> positions,
                                      LaplacianWeights scheme) {
  const Numbers weights = laplacian_weights(topology, positions, scheme, all_rows(topology));
  return {weights.begin(), weights.end()};
}

Numbers laplacian_weights(const Topology& topology, std::span<const Vector3d> positions,
                          LaplacianWeights scheme, std::span<const Index> rows) {
  Numbers weights(topology.rings.values.size());
  for_rows(topology, rows, weights, [&](Index i, std::span<double> row) {
    if (scheme == LaplacianWeights::uniform) return set_uniform(row);
    set_cotangents(topology, i, positions, row);
    make_weights(row);
  });
  return weights;
}

Numbers laplacian_weights(const Topology& topology, const Numbers& cotangent_sums,
                          std::span<const Index> rows) {
  Numbers weights(cotangent_sums.size());
  for_rows(topology, rows, weights, [&](Index i, std::span<double> row) {
    std::copy_n(cotangent_sums.data() + topology.rings.starts[i], row.size(), row.data());
    make_weights(row);
  });
  return weights;
}

Numbers cotangent_sums(const Topology& topology, std::span<const Vector3d> positions,
                       std::span<const Index> rows) {
  Numbers sums(topology.rings.values.size());
  for_rows(topology, rows, sums,
           [&](Index i, std::span<double> row) { set_cotangents(topology, i, positions, row); });
  return sums;
}

std::vector<double> edge_weights(const Topology& topology, std::span<const Vector3d> positions) {
  const Numbers sums = cotangent_sums(topology, positions, all_rows(topology));
  std::vector<double> weights(sums.begin(), sums.end());
  if (weights.empty()) return weights;
  if (!make_positive(weights)) {
    std::fill(weights.begin(), weights.end(), 1.0);
    return weights;
  }
  const double mean = sum_of(weights) / static_cast<double>(weights.size());
  for (double& w : weights) w /= mean;
  return weights;
}

}  // namespace lapwing
