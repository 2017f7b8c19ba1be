#include <algorithm>
#include <cstring>

#include "lapwing/base/instruction_set.h"
#include "lapwing/base/parallel.h"
#include "lapwing/kernels/cpu_ring_rotations.h"
#include "lapwing/laplacian/rotation.h"

namespace lapwing {

extern const FitBatchFunction kFitBatchBaseline;
#ifdef __x86_64__
extern const FitBatchFunction kFitBatchAvx2;
extern const FitBatchFunction kFitBatchAvx512;
#endif

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr std::size_t kBatchesPerTask = 128;
Matrix3d matrix_of(const double (&entries)[9][kFitLanes], int lane) {
  Matrix3d m;
  for (Eigen::Index k = 0; k < 9; ++k) m(k % 3, k / 3) = entries[k][lane];
  return m;
}
Vector3d vector_of(const double (&entries)[3][kFitLanes], int lane) {
  return {entries[0][lane], entries[1][lane], entries[2][lane]};
}

}  // namespace

FitBatchFunction fit_batch_function() {
#ifdef __x86_64__
  const InstructionSet set = available_instruction_sets().front();
  if (set == InstructionSet::avx512) return kFitBatchAvx512;
  if (set == InstructionSet::avx2) return kFitBatchAvx2;
#endif
  return kFitBatchBaseline;
}

void CpuRingRotations::fit_rotations(std::span<const Vector3d> displacement,
                                     std::span<double> energies) {
  constexpr std::size_t kVerticesPerTask = 8192;
  parallel_for(displacement.size(), kVerticesPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) displacement_[v].head<3>() = displacement[v];
  });
  parallel_for(rest_.size(), kBatchesPerTask, [&](std::size_t begin, std::size_t end) {
    FitBatch batch;
    for (std::size_t b = begin; b < end; ++b) {
      fit(b, batch);
      if (!transforms_.empty()) std::memcpy(transforms_[b].entries, batch.T, sizeof batch.T);
      const std::size_t first = b * kFitLanes;
      const std::size_t last = std::min(first + kFitLanes, rings_.row_count());
      for (std::size_t r = first; r < last; ++r) {
        const auto lane = static_cast<int>(r - first);
        turned_[r].head<3>() = vector_of(batch.turned, lane);
        energies[r] = batch.energy[lane];
        if (!rings_.stiffness.empty()) energies[r] += edge_energy(r);
      }
    }
  });
}

void CpuRingRotations::fit(std::size_t number, FitBatch& batch) const {
  const std::size_t begin = entry_starts_[number];
  const std::size_t count = entry_starts_[number + 1] - begin;
  const unsigned unsure =
      fit_batch_({rest_[number], entries_.data() + begin, count,
                  static_cast<Index>(number * kFitLanes), displacement_.front().data()},
                 motion_ == RingMotion::similarity, batch);
  if (unsure == 0) return;
  for (int lane = 0; lane < kFitLanes; ++lane) {
    if ((unsure >> static_cast<unsigned>(lane) & 1U) != 0) fit_lane(rest_[number], batch, lane);
  }
}

// What fit_batch leaves open: rings whose rotation takes the slow way.
void CpuRingRotations::fit_lane(const FitRest& rest, FitBatch& batch, int lane) const {
  const Matrix3d H = matrix_of(batch.H, lane);
  Matrix3d T = nearest_rotation(H);
  if (motion_ == RingMotion::similarity && rest.spread[lane] > 0.0) {
    T *= T.cwiseProduct(H).sum() / rest.spread[lane];
  }
  const Vector3d delta = vector_of(rest.delta, lane);
  const Vector3d wish = T * delta;
  batch.energy[lane] = (vector_of(batch.moved, lane) - wish).squaredNorm();
  for (Eigen::Index k = 0; k < 9; ++k) batch.T[k][lane] = T(k % 3, k / 3);
  for (Eigen::Index a = 0; a < 3; ++a) batch.turned[a][lane] = wish[a] - delta[a];
}

double CpuRingRotations::edge_energy(std::size_t row) const {
  const Matrix3d T = transform(row);
  double energy = 0.0;
  for (std::size_t e = rings_.starts[row]; e < rings_.starts[row + 1]; ++e) {
    const Vector3d moved = rings_.edges[e] + displacement_[rings_.neighbours[e]].head<3>() -
                           displacement_[row].head<3>();
    energy += rings_.stiffness[e] * (moved - T * rings_.edges[e]).squaredNorm();
  }
  return energy;
}

}  // namespace lapwing
