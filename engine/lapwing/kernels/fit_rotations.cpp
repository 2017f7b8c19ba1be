#include <algorithm>
#include <cstring>

#include "lapwing/base/instruction_set.h"
#include "lapwing/base/parallel.h"
#include "lapwing/kernels/cpu_ring_rotations.h"
#include "lapwing/laplacian/rotation.h"

namespace lapwing {

extern const FitBatchFunctions kFitBatchBaseline;
#ifdef __x86_64__
extern const FitBatchFunctions kFitBatchAvx2;
extern const FitBatchFunctions kFitBatchAvx512;
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

const FitBatchFunctions& fit_batch_functions() {
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
      const std::size_t first = b * kFitLanes;
      const std::size_t last = std::min(first + kFitLanes, rings_.row_count());
      for (std::size_t r = first; r < last; ++r) {
        const auto lane = static_cast<int>(r - first);
        transforms_[r] = matrix_of(batch.T, lane);
        residuals_[r].head<3>() = vector_of(batch.residual, lane);
        energies[r] = batch.energy[lane];
      }
    }
  });
}

void CpuRingRotations::fit(std::size_t number, FitBatch& batch) const {
  const std::size_t begin = entry_starts_[number];
  const FitRings rings{rest_[number], entries_.data() + begin, entry_starts_[number + 1] - begin,
                       static_cast<Index>(number * kFitLanes), displacement_.front().data()};
  const unsigned unsure = functions_.fit(rings, batch);
  if (unsure == 0) return;
  // Rings whose rotation takes the slow way.
  for (int lane = 0; lane < kFitLanes; ++lane) {
    if ((unsure >> static_cast<unsigned>(lane) & 1U) == 0) continue;
    const Matrix3d T = rings.rest.scale[lane] * nearest_rotation(matrix_of(batch.C, lane));
    for (Eigen::Index k = 0; k < 9; ++k) batch.T[k][lane] = T(k % 3, k / 3);
  }
  functions_.finish(rings, batch);
}

}  // namespace lapwing
