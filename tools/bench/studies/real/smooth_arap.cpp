#include "studies/real/smooth_arap.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "lapwing/base/errors.h"
#include "lapwing/laplacian/rotation.h"
#include "lapwing/mesh/topology.h"

namespace lapwing::bench {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Entries = std::vector<Eigen::Triplet<double>>;

// (cot alpha + cot beta) / 2 per edge (i, j) with i < j.
std::map<std::pair<Index, Index>, double> cotangents(const Mesh& mesh) {
  std::map<std::pair<Index, Index>, double> weights;
  const Positions& p = mesh.positions;
  for (const Triangle& t : mesh.topology().triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Index i = t[(k + 1) % 3];
      const Index j = t[(k + 2) % 3];
      const Vector3d a = p[i] - p[t[k]];
      const Vector3d b = p[j] - p[t[k]];
      const double area = a.cross(b).norm();
      if (area > 0.0) weights[std::minmax(i, j)] += 0.5 * a.dot(b) / area;
    }
  }
  return weights;
}

}  // namespace

SmoothArap::SmoothArap(const Mesh& mesh, const EditRegion& region, double lambda)
    : mesh_(mesh),
      region_(region),
      lambda_(lambda),
      edges_(region.roi.size()),
      laplacians_(region.roi.size(), Vector3d::Zero()),
      rotations_(region.roi.size(), Matrix3d::Identity()),
      unknown_(mesh.vertex_count(), -1),
      positions_(mesh.positions) {
  std::vector<std::vector<Edge>> all(mesh.vertex_count());
  for (const auto& [edge, weight] : cotangents(mesh)) {
    if (!(weight > 0.0)) continue;
    all[edge.first].push_back({edge.second, weight});
    all[edge.second].push_back({edge.first, weight});
  }

  for (const Index v : region.roi) unknown_[v] = 0;
  const auto hold = [this](const VertexSet& vertices) {
    for (const Index v : vertices) unknown_[v] = -1;
  };
  hold(region.belt);
  for (const VertexSet& handle : region.handles) hold(handle);
  Eigen::Index count = 0;
  for (const Index v : region.roi) {
    if (unknown_[v] >= 0) unknown_[v] = count++;
  }

  // Half of the Hessian of E at fixed rotations.
  Entries entries;
  const auto add = [&](Index row, Index column, double value) {
    if (unknown_[row] < 0) return;
    entries.emplace_back(static_cast<int>(unknown_[row]), static_cast<int>(column), value);
  };
  for (std::size_t k = 0; k < region.roi.size(); ++k) {
    const Index i = region.roi[k];
    edges_[k] = all[i];
    std::vector<std::pair<Index, double>> row{{i, 0.0}};  // of L
    for (const Edge& edge : edges_[k]) {
      laplacians_[k] += edge.weight * (mesh.positions[i] - mesh.positions[edge.to]);
      row[0].second += edge.weight;
      row.emplace_back(edge.to, -edge.weight);
      const double weight = (1.0 - lambda) * edge.weight;
      add(i, i, weight);
      add(edge.to, edge.to, weight);
      add(i, edge.to, -weight);
      add(edge.to, i, -weight);
    }
    for (const auto& [a, of_a] : row) {
      for (const auto& [b, of_b] : row) add(a, b, lambda * of_a * of_b);
    }
  }
  matrix_.resize(count, static_cast<Eigen::Index>(mesh.vertex_count()));
  matrix_.setFromTriplets(entries.begin(), entries.end());

  Entries of_unknowns;
  for (const auto& entry : entries) {
    const Eigen::Index column = unknown_[static_cast<std::size_t>(entry.col())];
    if (column >= 0) of_unknowns.emplace_back(entry.row(), static_cast<int>(column), entry.value());
  }
  Eigen::SparseMatrix<double> square(count, count);
  square.setFromTriplets(of_unknowns.begin(), of_unknowns.end());
  factor_.compute(square);
  if (factor_.info() != Eigen::Success) {
    throw SolverError("Smooth ARAP: its system could not be factored");
  }
}

void SmoothArap::move(std::span<const Eigen::Affine3d> motions) {
  positions_ = mesh_.positions;
  for (std::size_t h = 0; h < motions.size(); ++h) {
    for (const Index v : region_.handles[h]) positions_[v] = motions[h] * mesh_.positions[v];
  }
}

void SmoothArap::fit_rotations() {
  const Positions& rest = mesh_.positions;
  for (std::size_t k = 0; k < edges_.size(); ++k) {
    const Index i = region_.roi[k];
    Matrix3d covariance = Matrix3d::Zero();
    for (const Edge& edge : edges_[k]) {
      covariance += edge.weight * (positions_[i] - positions_[edge.to]) *
                    (rest[i] - rest[edge.to]).transpose();
    }
    rotations_[k] = nearest_rotation(covariance);
  }
}

void SmoothArap::solve() {
  const Positions& rest = mesh_.positions;
  Eigen::MatrixX3d right = Eigen::MatrixX3d::Zero(matrix_.rows(), 3);
  const auto add = [&](Index vertex, const Vector3d& value) {
    if (unknown_[vertex] >= 0) right.row(unknown_[vertex]) += value.transpose();
  };
  for (std::size_t k = 0; k < edges_.size(); ++k) {
    const Index i = region_.roi[k];
    const Vector3d laplacian = lambda_ * (rotations_[k] * laplacians_[k]);
    for (const Edge& edge : edges_[k]) {
      const Vector3d turned = rotations_[k] * (rest[i] - rest[edge.to]);
      const Vector3d pull = edge.weight * ((1.0 - lambda_) * turned + laplacian);
      add(i, pull);
      add(edge.to, -pull);
    }
  }
  for (Eigen::Index column = 0; column < matrix_.cols(); ++column) {
    const auto v = static_cast<std::size_t>(column);
    if (unknown_[v] >= 0) continue;
    for (Eigen::SparseMatrix<double>::InnerIterator it(matrix_, column); it; ++it) {
      right.row(it.row()) -= it.value() * positions_[v].transpose();
    }
  }
  const Eigen::MatrixX3d solution = factor_.solve(right);
  for (const Index v : region_.roi) {
    if (unknown_[v] >= 0) positions_[v] = solution.row(unknown_[v]).transpose();
  }
}

double SmoothArap::energy() const {
  const Positions& rest = mesh_.positions;
  double energy = 0.0;
  for (std::size_t k = 0; k < edges_.size(); ++k) {
    const Index i = region_.roi[k];
    Vector3d laplacian = -(rotations_[k] * laplacians_[k]);
    for (const Edge& edge : edges_[k]) {
      const Vector3d now = positions_[i] - positions_[edge.to];
      const Vector3d turned = rotations_[k] * (rest[i] - rest[edge.to]);
      energy += (1.0 - lambda_) * edge.weight * (now - turned).squaredNorm();
      laplacian += edge.weight * now;
    }
    energy += lambda_ * laplacian.squaredNorm();
  }
  return energy;
}

int SmoothArap::iterate(int most_iterations, double tolerance) {
  double before = 0.0;
  for (int iteration = 1; iteration <= most_iterations; ++iteration) {
    fit_rotations();
    solve();
    const double now = energy();
    if (iteration > 1 && std::abs(before - now) <= tolerance * now) return iteration;
    before = now;
  }
  return most_iterations;
}

}  // namespace lapwing::bench
