#include "lapwing/laplacian/energy_weights.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <Eigen/Geometry>

#include "lapwing/base/parallel.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

// Lower bound of a ring area, as a fraction of the mean ring area. It keeps row weights finite and
// of similar magnitude.
constexpr double kSmallestAreaShare = 1e-3;

// The weight of an edge between equilateral triangles, and the sum of the six weights around a
// vertex.
constexpr double kRegularWeight = std::numbers::inv_sqrt3;
constexpr double kRegularSum = 6.0 * kRegularWeight;

double ring_area(Index i, const Topology& topology, std::span<const Vector3d> positions) {
  double area = 0.0;
  for (const Index t : topology.vertex_triangles[i]) {
    const Triangle& c = topology.triangles[t];
    area += (positions[c[1]] - positions[c[0]]).cross(positions[c[2]] - positions[c[0]]).norm();
  }
  return area / 6.0;
}

// Returns the larger of the ring area of i and the mean ring area of its neighbours.
double area_around(Index i, const Adjacency& rings, std::span<const double> areas) {
  const auto ring = rings[i];
  double sum = 0.0;
  for (const Index j : ring) sum += areas[j];
  return ring.empty() ? areas[i] : std::max(areas[i], sum / static_cast<double>(ring.size()));
}

// Returns the ring areas of the vertices of `roi` and of their neighbours. All other entries are
// undefined.
Numbers ring_areas(const Topology& topology, std::span<const Vector3d> rest,
                   std::span<const Index> roi) {
  constexpr std::size_t kRowsPerTask = 2048;
  std::vector<char> seen(rest.size(), 0);
  std::vector<Index> vertices;
  vertices.reserve(roi.size());
  const auto add = [&](Index v) {
    if (std::exchange(seen[v], 1) == 0) vertices.push_back(v);
  };
  for (const Index i : roi) {
    add(i);
    for (const Index j : topology.rings[i]) add(j);
  }
  Numbers areas(rest.size());
  parallel_for(vertices.size(), kRowsPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      areas[vertices[k]] = ring_area(vertices[k], topology, rest);
    }
  });
  return areas;
}

// Returns A / r^2 for a region with area A and radius of gyration r: 4 pi for a sphere, 2 pi for a
// disk, and 12 divided by the aspect ratio for a narrow strip. A single vertex has the lower bound,
// kNarrowest.
double area_over_square_of_radius(std::span<const Vector3d> rest, std::span<const Index> roi,
                                  std::span<const double> areas) {
  constexpr double kNarrowest = 12.0 / 100.0;
  double area = 0.0;
  Vector3d centroid = Vector3d::Zero();
  for (const Index i : roi) {
    area += areas[i];
    centroid += areas[i] * (rest[i] - rest[roi[0]]);
  }
  if (!(area > 0.0)) return kNarrowest;
  centroid = rest[roi[0]] + centroid / area;
  double moment = 0.0;
  for (const Index i : roi) moment += areas[i] * (rest[i] - centroid).squaredNorm();
  if (!(moment > 0.0)) return kNarrowest;
  return std::max(area * (area / moment), kNarrowest);
}

Numbers row_weights(const Topology& topology, std::span<const Index> roi,
                    std::span<const double> areas) {
  double sum = 0.0;
  for (const Index i : roi) sum += areas[i];
  const double mean = sum / static_cast<double>(roi.size());
  Numbers rows(areas.size());
  for (const Index i : roi) {
    const double least = kSmallestAreaShare * mean;
    rows[i] = mean > 0.0 ? mean / std::max(area_around(i, topology.rings, areas), least) : 1.0;
  }
  return rows;
}

// The factor of rigid vertices. With a larger one, minimizations take more iterations (ENERGY.md
// section 8).
constexpr double kRigidFactor = 1e4;

void multiply_by_stiffness(const Adjacency& rings, std::span<const Index> roi,
                           std::span<const VertexStiffness> stiffness, EnergyWeights& weights) {
  if (stiffness.empty()) return;
  std::vector<double>& factors = weights.factors;
  factors.assign(rings.row_count(), 0.0);
  for (const Index i : roi) factors[i] = 1.0;
  for (const auto& [v, factor] : stiffness) factors[v] = std::min(factor, kRigidFactor);
  for (const Index i : roi) {
    weights.rows[i] *= factors[i];
    for (std::size_t e = rings.starts[i]; e < rings.starts[i + 1]; ++e) {
      // A neighbour outside the region has no factor of its own, so that a constant factor
      // multiplies the whole energy.
      const double other = factors[rings.values[e]];
      weights.stiffness[e] *= std::sqrt(factors[i] * (other > 0.0 ? other : factors[i]));
    }
  }
}

}  // namespace

EnergyWeights energy_weights(const Topology& topology, std::span<const Vector3d> rest,
                             std::span<const Index> roi, const EnergyTerms& terms) {
  EnergyWeights weights;
  if (!(terms.detail_length > 0.0)) {
    weights.laplacian = laplacian_weights(topology, rest, terms.weights, roi);
    return weights;
  }
  weights.stiffness = cotangent_sums(topology, rest, roi);
  weights.laplacian = terms.weights == LaplacianWeights::cotangent
                          ? laplacian_weights(topology, weights.stiffness, roi)
                          : laplacian_weights(topology, rest, terms.weights, roi);
  const Numbers areas = ring_areas(topology, rest, roi);
  weights.rows = row_weights(topology, roi, areas);
  const double mu =
      area_over_square_of_radius(rest, roi, areas) /
      (static_cast<double>(roi.size()) * kRegularSum * terms.detail_length * terms.detail_length);
  for (const Index i : roi) {
    for (std::size_t e = topology.rings.starts[i]; e < topology.rings.starts[i + 1]; ++e) {
      double& k = weights.stiffness[e];
      const double weight = std::max(0.5 * k, kSmallestCotangentShare * kRegularWeight);
      k = mu / (2.0 * kRegularSum) * weight;
    }
  }
  multiply_by_stiffness(topology.rings, roi, terms.stiffness, weights);
  return weights;
}

EnergyWeights with_laplacian(EnergyWeights weights, const Topology& topology,
                             std::span<const Vector3d> rest, std::span<const Index> roi,
                             LaplacianWeights scheme) {
  weights.laplacian = laplacian_weights(topology, rest, scheme, roi);
  return weights;
}

}  // namespace lapwing
