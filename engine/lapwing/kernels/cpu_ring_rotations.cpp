#include "lapwing/kernels/cpu_ring_rotations.h"

#include <algorithm>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/instruction_set.h"

namespace lapwing {

extern const RingLoops kRingLoopsBaseline;
#ifdef __x86_64__
extern const RingLoops kRingLoopsAvx2;
extern const RingLoops kRingLoopsAvx512;
#endif

using Eigen::Vector3d;

const RingLoops& ring_loops() {
#ifdef __x86_64__
  const InstructionSet set = available_instruction_sets().front();
  if (set == InstructionSet::avx512) return kRingLoopsAvx512;
  if (set == InstructionSet::avx2) return kRingLoopsAvx2;
#endif
  return kRingLoopsBaseline;
}

CpuRingRotations::CpuRingRotations(const RegionRings& rings)
    : rings_(rings),
      loops_(ring_loops()),
      rest_((rings.row_count() + kFitLanes - 1) / kFitLanes),
      displacement_(std::max(rings.vertices.size(), rest_.size() * kFitLanes)),
      turns_(rings.vertices.size()),
      residuals_(rings.vertices.size()) {
  entry_starts_.push_back(0);
  CancelCheck cancel_check;
  for (std::size_t batch = 0; batch < rest_.size(); ++batch) {
    cancel_check();
    pack_batch(batch);
  }
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
    Vector3d delta = Vector3d::Zero();
    for (std::size_t e = rings_.starts[r]; e < rings_.starts[r + 1]; ++e) {
      const std::size_t at = begin + e - rings_.starts[r];
      if (at == entries_.size()) entries_.push_back(none);
      FitEntries& entry = entries_[at];
      for (Eigen::Index a = 0; a < 3; ++a) entry.edge[a][lane] = rings_.edges[e][a];
      entry.weight[lane] = rings_.weights[e];
      if (!rings_.stiffness.empty()) entry.stiffness[lane] = rings_.stiffness[e];
      entry.neighbour[lane] = rings_.neighbours[e];
      delta -= rings_.weights[e] * rings_.edges[e];
    }
    for (Eigen::Index a = 0; a < 3; ++a) rest.delta[a][lane] = delta[a];
    rest.weight[lane] = rings_.row_weights[r];
    rest.scale[lane] = 1.0;
  }
  entry_starts_.push_back(entries_.size());
}

std::vector<Eigen::Matrix3d> CpuRingRotations::transforms() const {
  std::vector<Eigen::Matrix3d> transforms(rings_.row_count(), Eigen::Matrix3d::Identity());
  for (std::size_t r = 0; r < transforms.size(); ++r) {
    for (Eigen::Index c = 0; c < 3; ++c) {
      transforms[r].col(c) += Eigen::Map<const Vector3d>(turns_[r].column[c].xyz0);
    }
  }
  return transforms;
}

void CpuRingRotations::set_scales(std::span<const double> scales) {
  for (std::size_t r = 0; r < scales.size(); ++r) {
    rest_[r / kFitLanes].scale[r % kFitLanes] = scales[r];
  }
}

}  // namespace lapwing
