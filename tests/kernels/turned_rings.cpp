#include "kernels/turned_rings.h"

#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include <Eigen/Geometry>

namespace lapwing::test {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Vector3d TurnedRings::moved_edge(std::size_t row, std::size_t entry) const {
  return rings.edges[entry] + displacement[rings.neighbours[entry]] - displacement[row];
}

Matrix3d TurnedRings::covariance(std::size_t row) const {
  Matrix3d C = rings.row_weights[row] * moved_laplacian(row) * rest_laplacian(row).transpose();
  for (std::size_t e = rings.starts[row]; e < rings.starts[row + 1]; ++e) {
    if (!rings.stiffness.empty()) {
      C += rings.stiffness[e] * moved_edge(row, e) * rings.edges[e].transpose();
    }
  }
  return C;
}

Vector3d TurnedRings::rest_laplacian(std::size_t row) const {
  Vector3d sum = Vector3d::Zero();
  for (std::size_t e = rings.starts[row]; e < rings.starts[row + 1]; ++e) {
    sum -= rings.weights[e] * rings.edges[e];
  }
  return sum;
}

Vector3d TurnedRings::moved_laplacian(std::size_t row) const {
  Vector3d sum = Vector3d::Zero();
  for (std::size_t e = rings.starts[row]; e < rings.starts[row + 1]; ++e) {
    sum -= rings.weights[e] * moved_edge(row, e);
  }
  return sum;
}

Vector3d turning_axis() {
  return Vector3d(1.0, -2.0, 0.5).normalized();
}

TurnedRings turned_rings(const Sample& sample, double degrees, double noise, double mu,
                         unsigned seed) {
  const Positions& rest = sample.mesh.positions;
  EnergyWeights weights;
  weights.laplacian =
      laplacian_weights(sample.topology, rest, LaplacianWeights::cotangent, sample.vertices);
  for (std::size_t v = 0; v < rest.size(); ++v) {
    weights.rows.push_back(0.5 + 0.2 * static_cast<double>(v % 7));
  }
  if (mu > 0.0) {
    for (const double w : edge_weights(sample.topology, rest)) {
      weights.stiffness.push_back(0.5 * mu * w);
    }
  }
  const std::size_t row_count = (2 * rest.size() + 2) / 3;
  const auto rows = std::span(sample.vertices).first(row_count);
  std::vector<Index> unknowns;
  for (const Index v : rows) {
    if (v % 5 != 3) unknowns.push_back(v);
  }
  TurnedRings result;
  result.rings = region_rings(sample.topology, rest, weights, rows, unknowns);

  std::mt19937 generator(seed);
  const double edge = mean_edge_length(sample.topology.rings, rest);
  std::uniform_real_distribution<double> uniform(-noise * edge, noise * edge);
  const Vector3d center = bounds_of(rest).center();
  const Eigen::AngleAxisd turn(degrees * std::numbers::pi / 180.0, turning_axis());
  for (const Index v : result.rings.vertices) {
    const Vector3d there = turn * (rest[v] - center) + center + 20.0 * edge * Vector3d(1, 2, -3);
    result.displacement.push_back(there - rest[v]);
    for (double& coordinate : result.displacement.back()) coordinate += uniform(generator);
  }
  return result;
}

std::vector<Matrix3d> different_stretches(std::size_t count) {
  std::vector<Matrix3d> all;
  for (std::size_t r = 0; r < count; ++r) {
    const auto k = static_cast<double>(r);
    const Matrix3d axes =
        Eigen::AngleAxisd(0.7 * k, Vector3d(1.0, std::sin(k), 2.0).normalized()).toRotationMatrix();
    const Vector3d stretches(0.5 + 0.3 * std::fmod(k, 5.0), 1.1, 0.8);
    all.emplace_back(axes * stretches.asDiagonal() * axes.transpose());
  }
  return all;
}

double Fitted::energy() const {
  return std::accumulate(energies.begin(), energies.end(), 0.0);
}

Fitted fit(RingRotations& rotations, const TurnedRings& turned, std::span<const Matrix3d> stretch) {
  Fitted result;
  result.energies.resize(turned.rings.row_count());
  result.gradient.resize(3 * turned.rings.unknown_rows.size());
  rotations.set_rest_stretch(stretch);
  rotations.fit_rotations(turned.displacement, result.energies);
  rotations.energy_gradient(result.gradient);
  result.transforms = rotations.transforms();
  return result;
}

Fitted fit(Kernels& kernels, const TurnedRings& turned, std::span<const Matrix3d> stretch) {
  return fit(*kernels.make_ring_rotations(std::make_shared<RegionRings>(turned.rings)), turned,
             stretch);
}

}  // namespace lapwing::test
