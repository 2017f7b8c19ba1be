#include "lapwing/kernels/cpu_ring_rotations.h"

namespace lapwing {

CpuRingRotations::CpuRingRotations(const RegionRings& rings, RingMotion motion)
    : rings_(rings),
      motion_(motion),
      fit_batch_(fit_batch_function()),
      displacement_(rings.vertices.size(), Vector4::Zero()),
      transforms_(rings.row_count(), Eigen::Matrix3d::Identity()),
      turned_(rings.row_count(), Vector4::Zero()) {
  edges_.reserve(rings.edges.size());
  for (std::size_t e = 0; e < rings.edges.size(); ++e) {
    const Eigen::Vector3d& edge = rings.edges[e];
    edges_.emplace_back(edge.x(), edge.y(), edge.z(), rings.weights[e]);
  }
}

}  // namespace lapwing
