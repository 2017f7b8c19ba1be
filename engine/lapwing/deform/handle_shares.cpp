#include "lapwing/deform/handle_shares.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace lapwing {

using Eigen::Affine3d;
using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

// Whether the surface is held by handles alone: no belt, and no neighbour outside the region.
bool handles_hold_all(const EditSystem& system) {
  if (!system.region.belt.empty()) return false;
  std::vector<char> in_roi(system.rest->size(), 0);
  for (const Index v : system.region.roi) in_roi[v] = 1;
  return std::all_of(system.region.roi.begin(), system.region.roi.end(), [&](Index v) {
    const auto ring = system.topology.rings[v];
    return std::all_of(ring.begin(), ring.end(), [&](Index j) { return in_roi[j] != 0; });
  });
}

}  // namespace

HandleShares::HandleShares(const EditSystem& system) : system_(system) {
  const LaplacianSystem& laplacian = system.systems->laplacian();
  const Unknowns& unknowns = system.constraints.unknowns;
  const VertexSet& roi = system.region.roi;
  const std::size_t n = laplacian.size();
  std::vector<double> b(3 * n);
  for (const VertexSet& handle : system.region.handles) {
    std::vector<Vector3d> one(system.rest->size(), Vector3d::Zero());
    for (const Index v : handle) one[v].x() = 1.0;
    laplacian.right_hand_side(one, b);
    laplacian.solve_in_place(std::span(b).first(n), 1);
    for (const Index v : roi) {
      const Index u = unknowns.of_vertex[v];
      shares_.push_back(u == kNoIndex ? one[v].x() : std::clamp(b[u], 0.0, 1.0));
    }
  }
  const bool all = handles_hold_all(system);
  for (std::size_t r = 0; r < roi.size(); ++r) {
    double sum = 0.0;
    for (std::size_t at = r; at < shares_.size(); at += roi.size()) sum += shares_[at];
    if (sum == 0.0 || (sum <= 1.0 && !all)) continue;
    for (std::size_t at = r; at < shares_.size(); at += roi.size()) shares_[at] /= sum;
  }
}

std::span<const double> HandleShares::of_handle(std::size_t handle) const {
  const std::size_t count = system_.region.roi.size();
  return std::span(shares_).subspan(handle * count, count);
}

std::vector<double> HandleShares::scales(std::span<const double> handle_scales) const {
  std::vector<double> scales(system_.rest->size(), 1.0);
  for (std::size_t h = 0; h < handle_scales.size(); ++h) {
    const auto shares = of_handle(h);
    for (std::size_t r = 0; r < shares.size(); ++r) {
      scales[system_.region.roi[r]] += shares[r] * (handle_scales[h] - 1.0);
    }
  }
  return scales;
}

std::vector<Vector3d> HandleShares::turned(std::span<const Affine3d> motions,
                                           std::span<const AngleAxisd> turns) const {
  const EditSystem& s = system_;
  const VertexSet& roi = s.region.roi;
  std::vector<Matrix3d> stretches;  // of each handle, less the identity
  for (std::size_t h = 0; h < motions.size(); ++h) {
    stretches.push_back(turns[h].toRotationMatrix().transpose() * motions[h].linear() -
                        Matrix3d::Identity());
  }
  std::vector<Vector3d> u(s.rest->size(), Vector3d::Zero());
  for (std::size_t r = 0; r < roi.size(); ++r) {
    double sum = 0.0;
    Vector3d turn = Vector3d::Zero();
    Matrix3d stretch = Matrix3d::Identity();
    Vector3d pivot = Vector3d::Zero();
    Vector3d move = Vector3d::Zero();
    for (std::size_t h = 0; h < motions.size(); ++h) {
      const double share = shares_[h * roi.size() + r];
      const Vector3d& centroid = s.frames[h].centroid;
      sum += share;
      turn += share * turns[h].angle() * turns[h].axis();
      stretch += share * stretches[h];
      pivot += share * centroid;
      move += share * (motions[h] * centroid - centroid);
    }
    if (sum == 0.0) continue;
    const Vector3d arm = (*s.rest)[roi[r]] - pivot / sum;
    const Vector3d stretched = stretch * arm;
    const double angle = turn.norm();
    u[roi[r]] = move - arm +
                (angle > 0.0 ? Vector3d(AngleAxisd(angle, turn / angle) * stretched) : stretched);
  }
  return u;
}

double scale_of(const Affine3d& motion) {
  return std::max(kLeastScale, std::cbrt(std::abs(motion.linear().determinant())));
}

}  // namespace lapwing
