#include "lapwing/kernels/cpu_ring_rotations.h"

#include <algorithm>

namespace lapwing {

using Eigen::Vector3d;

CpuRingRotations::CpuRingRotations(const RegionRings& rings, RingMotion motion)
    : rings_(rings),
      motion_(motion),
      fit_batch_(fit_batch_function()),
      rest_((rings.row_count() + kFitLanes - 1) / kFitLanes),
      displacement_(std::max(rings.vertices.size(), rest_.size() * kFitLanes), Vector4::Zero()),
      transforms_(rings.stiffness.empty() ? 0 : rest_.size()),
      turned_(rings.vertices.size(), Vector4::Zero()) {
  entry_starts_.push_back(0);
  for (std::size_t batch = 0; batch < rest_.size(); ++batch) pack_batch(batch);
}

void CpuRingRotations::pack_batch(std::size_t batch) {
  const std::size_t first = batch * kFitLanes;
  const std::size_t last = std::min(first + kFitLanes, rings_.row_count());
  const std::size_t begin = entries_.size();
  FitEntries none{};
  for (std::size_t lane = 0; lane < kFitLanes; ++lane) {
    none.neighbour[lane] = static_cast<Index>(first + lane);
  }
  FitRest& rest = rest_[batch];
  for (std::size_t r = first; r < last; ++r) {
    const std::size_t lane = r - first;
    Vector3d center = Vector3d::Zero();
    for (std::size_t e = rings_.starts[r]; e < rings_.starts[r + 1]; ++e) center += rings_.edges[e];
    center /= static_cast<double>(rings_.starts[r + 1] - rings_.starts[r] + 1);
    Vector3d delta = Vector3d::Zero();
    rest.spread[lane] = center.squaredNorm();
    for (std::size_t e = rings_.starts[r]; e < rings_.starts[r + 1]; ++e) {
      const std::size_t at = begin + e - rings_.starts[r];
      if (at == entries_.size()) entries_.push_back(none);
      const Vector3d arm = rings_.edges[e] - center;
      for (Eigen::Index a = 0; a < 3; ++a) entries_[at].arm[a][lane] = arm[a];
      entries_[at].weight[lane] = rings_.weights[e];
      entries_[at].neighbour[lane] = rings_.neighbours[e];
      rest.spread[lane] += arm.squaredNorm();
      delta -= rings_.weights[e] * rings_.edges[e];
    }
    for (Eigen::Index a = 0; a < 3; ++a) {
      rest.center[a][lane] = center[a];
      rest.delta[a][lane] = delta[a];
    }
  }
  entry_starts_.push_back(entries_.size());
}

Eigen::Matrix3d CpuRingRotations::transform(std::size_t row) const {
  const Transforms& batch = transforms_[row / kFitLanes];
  const std::size_t lane = row % kFitLanes;
  Eigen::Matrix3d T;
  for (Eigen::Index k = 0; k < 9; ++k) T(k % 3, k / 3) = batch.entries[k][lane];
  return T;
}

std::vector<Eigen::Matrix3d> CpuRingRotations::transforms() const {
  std::vector<Eigen::Matrix3d> all(rings_.row_count());
  FitBatch batch;
  for (std::size_t r = 0; r < all.size(); ++r) {
    if (r % kFitLanes == 0) fit(r / kFitLanes, batch);
    for (Eigen::Index k = 0; k < 9; ++k) all[r](k % 3, k / 3) = batch.T[k][r % kFitLanes];
  }
  return all;
}

}  // namespace lapwing
