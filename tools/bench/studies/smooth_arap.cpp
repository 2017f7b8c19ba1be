#include "studies/smooth_arap.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lapwing/base/errors.h"
#include "lapwing/laplacian/rotation.h"
#include "lapwing/laplacian/weights.h"

namespace lapwing::bench {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Triplets = std::vector<Eigen::Triplet<double>>;

}  // namespace

template <class Visit>
void SmoothArap::for_each_edge(const Visit& visit) const {
  for (Index i = 0; i < rings_.row_count(); ++i) {
    for (Index k = rings_.starts[i]; k < rings_.starts[i + 1]; ++k) {
      const Index j = rings_.values[k];
      visit(i, j, w_[k], Vector3d(rest_.row(i) - rest_.row(j)));
    }
  }
}

SmoothArap::SmoothArap(const Mesh& mesh, const EditRegion& region, double lambda)
    : region_(region),
      rings_(mesh.topology().rings),
      lambda_(lambda),
      rest_(mesh.vertex_count(), 3),
      rotations_(mesh.vertex_count(), Matrix3d::Identity()) {
  const auto n = static_cast<Eigen::Index>(mesh.vertex_count());
  std::vector<Index> vertices(mesh.vertex_count());
  std::iota(vertices.begin(), vertices.end(), Index{0});
  for (const Index v : vertices) rest_.row(v) = mesh.positions[v].transpose();
  current_ = rest_;
  for (const double sum : cotangent_sums(mesh.topology(), mesh.positions, vertices)) {
    w_.push_back(std::max(0.0, 0.5 * sum));
  }

  Triplets entries;
  for_each_edge([&](Index i, Index j, double w, const Vector3d&) {
    entries.emplace_back(i, i, w);
    entries.emplace_back(i, j, -w);
  });
  L_.resize(n, n);
  L_.setFromTriplets(entries.begin(), entries.end());
  // Each edge counts from both of its ends.
  A_ = 2.0 * (1.0 - lambda) * L_ + lambda * Sparse(L_.transpose() * L_);

  std::vector<bool> is_held(mesh.vertex_count(), false);
  for (const Index v : region.belt) is_held[v] = true;
  for (const VertexSet& handle : region.handles) {
    for (const Index v : handle) is_held[v] = true;
  }
  Triplets ones;
  for (const Index v : region.roi) {
    if (!is_held[v]) ones.emplace_back(v, ones.size(), 1.0);
  }
  free_.resize(n, static_cast<Eigen::Index>(ones.size()));
  free_.setFromTriplets(ones.begin(), ones.end());
  factor_.compute(free_.transpose() * A_ * free_);
  if (factor_.info() != Eigen::Success) throw SolverError("singular matrix");
}

void SmoothArap::move(std::span<const Eigen::Affine3d> motions) {
  current_ = rest_;
  for (std::size_t h = 0; h < motions.size(); ++h) {
    for (const Index v : region_.handles[h]) {
      current_.row(v) = (motions[h] * Vector3d(rest_.row(v))).transpose();
    }
  }
}

void SmoothArap::fit_rotations() {
  std::fill(rotations_.begin(), rotations_.end(), Matrix3d::Zero());
  for_each_edge([&](Index i, Index j, double w, const Vector3d& edge) {
    rotations_[i] += w * (current_.row(i) - current_.row(j)).transpose() * edge.transpose();
  });
  details_ = L_ * rest_;
  for (std::size_t i = 0; i < rotations_.size(); ++i) {
    rotations_[i] = nearest_rotation(rotations_[i]);
    details_.row(i) *= rotations_[i].transpose();
  }
}

void SmoothArap::solve() {
  Points b = lambda_ * (L_.transpose() * details_);
  for_each_edge([&](Index i, Index j, double w, const Vector3d& edge) {
    const Vector3d pull = (1.0 - lambda_) * w * (rotations_[i] * edge);
    b.row(i) += pull.transpose();
    b.row(j) -= pull.transpose();
  });
  const Points residual = free_.transpose() * (b - A_ * current_);
  current_ += free_ * factor_.solve(residual);
}

double SmoothArap::energy() const {
  double edges = 0.0;
  for_each_edge([&](Index i, Index j, double w, const Vector3d& edge) {
    const Vector3d now = current_.row(i) - current_.row(j);
    edges += w * (now - rotations_[i] * edge).squaredNorm();
  });
  return (1.0 - lambda_) * edges + lambda_ * (L_ * current_ - details_).squaredNorm();
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

Positions SmoothArap::positions() const {
  Positions positions;
  for (Eigen::Index v = 0; v < current_.rows(); ++v) positions.emplace_back(current_.row(v));
  return positions;
}

}  // namespace lapwing::bench
