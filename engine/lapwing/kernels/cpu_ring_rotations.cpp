#include "lapwing/kernels/cpu_ring_rotations.h"

namespace lapwing {

CpuRingRotations::CpuRingRotations(const RegionRings& rings, RingMotion motion)
    : rings_(rings),
      motion_(motion),
      fit_batch_(fit_batch_function()),
      displacement_(rings.vertices.size(), Vector4::Zero()),
      transforms_((rings.row_count() + kFitLanes - 1) / kFitLanes),
      turned_(rings.row_count(), Vector4::Zero()) {
  edges_.reserve(rings.edges.size());
  for (std::size_t e = 0; e < rings.edges.size(); ++e) {
    const Eigen::Vector3d& edge = rings.edges[e];
    edges_.emplace_back(edge.x(), edge.y(), edge.z(), rings.weights[e]);
  }
}

Eigen::Matrix3d CpuRingRotations::transform(std::size_t row) const {
  const Transforms& batch = transforms_[row / kFitLanes];
  const std::size_t lane = row % kFitLanes;
  Eigen::Matrix3d T;
  for (Eigen::Index k = 0; k < 9; ++k) T(k % 3, k / 3) = batch.entries[k][lane];
  return T;
}

std::vector<Eigen::Matrix3d> CpuRingRotations::transforms() const {
  std::vector<Eigen::Matrix3d> all;
  for (std::size_t r = 0; r < rings_.row_count(); ++r) all.push_back(transform(r));
  return all;
}

}  // namespace lapwing
