#include "lapwing/kernels/cpu_ring_rotations.h"

#include <algorithm>
#include <utility>

#include "lapwing/base/parallel.h"
#include "lapwing/laplacian/rotation.h"

namespace lapwing {

extern const RingLoops kRingLoopsBaseline;
#ifdef __x86_64__
extern const RingLoops kRingLoopsAvx2;
extern const RingLoops kRingLoopsAvx512;
#endif

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

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

const RingLoops& ring_loops([[maybe_unused]] InstructionSet set) {
#ifdef __x86_64__
  if (set == InstructionSet::avx512) return kRingLoopsAvx512;
  if (set == InstructionSet::avx2) return kRingLoopsAvx2;
#endif
  return kRingLoopsBaseline;
}

CpuRingRotations::CpuRingRotations(std::shared_ptr<const RegionRings> rings, InstructionSet set)
    : shared_rings_(std::move(rings)),
      loops_(ring_loops(set)),
      rest_((rings_.row_count() + kFitLanes - 1) / kFitLanes),
      displacement_(std::max(rings_.vertices.size(), rest_.size() * kFitLanes)),
      turns_(rings_.vertices.size()),
      residuals_(rings_.vertices.size()) {
  constexpr std::size_t kBatchesPerTask = 64;
  entry_starts_.reserve(rest_.size() + 1);
  entry_starts_.push_back(0);
  for (std::size_t batch = 0; batch < rest_.size(); ++batch) {
    const std::size_t first = batch * kFitLanes;
    const std::size_t last = std::min(first + kFitLanes, rings_.row_count());
    std::size_t longest = 0;
    for (std::size_t r = first; r < last; ++r) {
      longest = std::max<std::size_t>(longest, rings_.starts[r + 1] - rings_.starts[r]);
    }
    entry_starts_.push_back(entry_starts_.back() + longest);
  }
  entries_.resize(entry_starts_.back());
  parallel_for(rest_.size(), kBatchesPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t batch = begin; batch < end; ++batch) pack_batch(batch);
  });
}

void CpuRingRotations::pack_batch(std::size_t batch) {
  const std::size_t first = batch * kFitLanes;
  const std::size_t last = std::min(first + kFitLanes, rings_.row_count());
  FitEntries* const entries = entries_.data() + entry_starts_[batch];
  FitEntries none{};
  for (std::size_t lane = 0; lane < kFitLanes; ++lane) {
    none.neighbour[lane] = static_cast<Index>(first + lane);
  }
  std::fill(entries, entries_.data() + entry_starts_[batch + 1], none);
  FitRest& rest = rest_[batch];
  for (std::size_t r = first; r < last; ++r) {
    const std::size_t lane = r - first;
    Vector3d delta = Vector3d::Zero();
    for (std::size_t e = rings_.starts[r]; e < rings_.starts[r + 1]; ++e) {
      FitEntries& entry = entries[e - rings_.starts[r]];
      for (Eigen::Index a = 0; a < 3; ++a) entry.edge[a][lane] = rings_.edges[e][a];
      entry.weight[lane] = rings_.weights[e];
      if (!rings_.stiffness.empty()) entry.stiffness[lane] = rings_.stiffness[e];
      entry.neighbour[lane] = rings_.neighbours[e];
      delta -= rings_.weights[e] * rings_.edges[e];
    }
    for (Eigen::Index a = 0; a < 3; ++a) rest.delta[a][lane] = delta[a];
    rest.weight[lane] = rings_.row_weights[r];
  }
}

void CpuRingRotations::fit_rotations(std::span<const Vector3d> displacement,
                                     std::span<double> energies) {
  constexpr std::size_t kVerticesPerTask = 8192;
  constexpr std::size_t kBatchesPerTask = 32;
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
  // The rotations of these rings are computed by the slow, robust method.
  for (int lane = 0; lane < kFitLanes; ++lane) {
    if ((unsure >> static_cast<unsigned>(lane) & 1U) == 0) continue;
    Matrix3d T = nearest_rotation(matrix_of(batch.C, lane));
    if (rings.stretch != nullptr) T = T * stretch_of(*rings.stretch, lane);
    for (Eigen::Index k = 0; k < 9; ++k) batch.T[k][lane] = T(k % 3, k / 3);
  }
  loops_.finish(rings, batch);
}

void CpuRingRotations::energy_gradient(std::span<double> g) {
  constexpr std::size_t kUnknownsPerTask = 256;
  const GradientRings rings{rings_.starts.data(),
                            rings_.neighbours.data(),
                            rings_.edges.empty() ? nullptr : rings_.edges.front().data(),
                            rings_.reverse_weights.data(),
                            rings_.stiffness.empty() ? nullptr : rings_.stiffness.data(),
                            rings_.row_count(),
                            rings_.unknown_rows.data(),
                            rings_.unknown_rows.size(),
                            displacement_.data(),
                            residuals_.data(),
                            turns_.data()};
  parallel_for(rings.unknown_count, kUnknownsPerTask, [&](std::size_t first, std::size_t last) {
    loops_.gradient(rings, first, last, g.data());
  });
}

std::vector<Matrix3d> CpuRingRotations::transforms() const {
  std::vector<Matrix3d> transforms(rings_.row_count(), Matrix3d::Identity());
  for (std::size_t r = 0; r < transforms.size(); ++r) {
    for (Eigen::Index c = 0; c < 3; ++c) {
      transforms[r].col(c) += Eigen::Map<const Vector3d>(turns_[r].column[c].xyz0);
    }
  }
  return transforms;
}

void CpuRingRotations::set_rest_stretch(std::span<const Matrix3d> stretch) {
  if (stretch.empty()) return stretch_.clear();
  FitStretch identity{};
  for (int k = 0; k < 3; ++k) std::fill_n(identity.S[k], kFitLanes, 1.0);
  stretch_.resize(rest_.size(), identity);
  for (std::size_t r = 0; r < stretch.size(); ++r) {
    const Matrix3d& S = stretch[r];
    const double numbers[] = {S(0, 0), S(1, 1), S(2, 2), S(1, 2), S(0, 2), S(0, 1)};
    for (int k = 0; k < 6; ++k) stretch_[r / kFitLanes].S[k][r % kFitLanes] = numbers[k];
  }
}

}  // namespace lapwing
