#include <algorithm>

#include "lapwing/base/parallel.h"
#include "lapwing/kernels/cpu_ring_rotations.h"
#include "lapwing/laplacian/rotation.h"

namespace lapwing {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr std::size_t kBatchesPerTask = 32;

Matrix3d matrix_of(const double (&entries)[9][kFitLanes], int lane) {
  Matrix3d m;
  for (Eigen::Index k = 0; k < 9; ++k) m(k % 3, k / 3) = entries[k][lane];
  return m;
}

Matrix3d stretch_of(const FitStretch& stretch, int lane) {
  const auto& S = stretch.S;
  Matrix3d m;
  m << S[0][lane], S[5][lane], S[4][lane],  //
      S[5][lane], S[1][lane], S[3][lane],   //
      S[4][lane], S[3][lane], S[2][lane];
  return m;
}

}  // namespace

void CpuRingRotations::fit_rotations(std::span<const Vector3d> displacement,
                                     std::span<double> energies) {
  constexpr std::size_t kVerticesPerTask = 8192;
  parallel_for(displacement.size(), kVerticesPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      std::copy_n(displacement[v].data(), 3, displacement_[v].xyz0);
    }
  });
  parallel_for(rest_.size(), kBatchesPerTask, [&](std::size_t begin, std::size_t end) {
    FitBatch batch;
    for (std::size_t b = begin; b < end; ++b) {
      fit(b, batch);
      const std::size_t first = b * kFitLanes;
      const std::size_t last = std::min(first + kFitLanes, rings_.row_count());
      for (std::size_t r = first; r < last; ++r) {
        const auto lane = static_cast<int>(r - first);
        for (std::size_t k = 0; k < 9; ++k) {
          turns_[r].column[k / 3].xyz0[k % 3] = batch.T[k][lane] - (k % 4 == 0 ? 1.0 : 0.0);
        }
        for (std::size_t a = 0; a < 3; ++a) residuals_[r].xyz0[a] = batch.residual[a][lane];
        energies[r] = batch.energy[lane];
      }
    }
  });
}

void CpuRingRotations::fit(std::size_t number, FitBatch& batch) const {
  const std::size_t begin = entry_starts_[number];
  const FitRings rings{rest_[number],
                       entries_.data() + begin,
                       entry_starts_[number + 1] - begin,
                       static_cast<Index>(number * kFitLanes),
                       displacement_.data(),
                       stretch_.empty() ? nullptr : &stretch_[number]};
  const unsigned unsure = loops_.fit(rings, batch);
  if (unsure == 0) return;
  // These rings need the slow, robust fit.
  for (int lane = 0; lane < kFitLanes; ++lane) {
    if ((unsure >> static_cast<unsigned>(lane) & 1U) == 0) continue;
    Matrix3d T = nearest_rotation(matrix_of(batch.C, lane));
    if (rings.stretch != nullptr) T = T * stretch_of(*rings.stretch, lane);
    for (Eigen::Index k = 0; k < 9; ++k) batch.T[k][lane] = T(k % 3, k / 3);
  }
  loops_.finish(rings, batch);
}

}  // namespace lapwing
