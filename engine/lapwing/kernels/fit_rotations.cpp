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
constexpr std::size_t kVerticesPerTask = 8192;

Matrix3d matrix_of(const double (&entries)[9][kFitLanes], int lane) {
  Matrix3d m;
  for (Eigen::Index k = 0; k < 9; ++k) m(k % 3, k / 3) = entries[k][lane];
  return m;
}
const double* numbers_of(const std::vector<Eigen::Vector4d>& vectors) {
  return vectors.empty() ? nullptr : vectors.front().data();
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
  parallel_for(displacement.size(), kVerticesPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) displacement_[v].head<3>() = displacement[v];
  });
  const std::size_t rows = rings_.row_count();
  const std::size_t batches = (rows + kFitLanes - 1) / kFitLanes;
  parallel_for(batches, kBatchesPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) {
      const std::size_t first = b * kFitLanes;
      fit_rows(first, static_cast<int>(std::min<std::size_t>(kFitLanes, rows - first)), energies);
    }
  });
}

// What fit_batch leaves open: rings whose rotation takes the slow way.
void CpuRingRotations::fit_lane(FitBatch& batch, int lane) const {
  const Matrix3d H = matrix_of(batch.H, lane);
  Matrix3d T = nearest_rotation(H);
  if (motion_ == RingMotion::similarity && batch.spread[lane] > 0.0) {
    T *= T.cwiseProduct(H).sum() / batch.spread[lane];
  }
  const Vector3d delta = vector_of(batch.delta, lane);
  const Vector3d wish = T * delta;
  batch.energy[lane] = (vector_of(batch.moved, lane) - wish).squaredNorm();
  for (Eigen::Index k = 0; k < 9; ++k) batch.T[k][lane] = T(k % 3, k / 3);
  for (Eigen::Index a = 0; a < 3; ++a) batch.turned[a][lane] = wish[a] - delta[a];
}

void CpuRingRotations::fit_rows(std::size_t first, int count, std::span<double> energies) {
  FitBatch batch;
  const unsigned unsure = fit_batch_({rings_.starts.data(), rings_.neighbours.data(),
                                      numbers_of(edges_), numbers_of(displacement_)},
                                     first, count, motion_ == RingMotion::similarity, batch);
  for (int lane = 0; lane < count; ++lane) {
    if ((unsure >> static_cast<unsigned>(lane) & 1U) != 0) fit_lane(batch, lane);
  }
  std::memcpy(transforms_[first / kFitLanes].entries, batch.T, sizeof batch.T);
  for (int lane = 0; lane < count; ++lane) {
    const std::size_t r = first + static_cast<std::size_t>(lane);
    turned_[r].head<3>() = vector_of(batch.turned, lane);
    energies[r] = batch.energy[lane];
    if (!rings_.stiffness.empty()) energies[r] += edge_energy(r);
  }
}

double CpuRingRotations::edge_energy(std::size_t row) const {
  const Matrix3d T = transform(row);
  double energy = 0.0;
  for (std::size_t e = rings_.starts[row]; e < rings_.starts[row + 1]; ++e) {
    const Vector3d moved = edges_[e].head<3>() + displacement_[rings_.neighbours[e]].head<3>() -
                           displacement_[row].head<3>();
    energy += rings_.stiffness[e] * (moved - T * edges_[e].head<3>()).squaredNorm();
  }
  return energy;
}

}  // namespace lapwing
