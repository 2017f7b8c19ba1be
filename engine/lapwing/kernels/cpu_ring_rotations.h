#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "lapwing/kernels/kernels.h"
#include "lapwing/kernels/ring_loops.h"

namespace lapwing {

/// RingRotations in double precision, on all threads. Allocates memory only in the constructor and
/// for the first rest stretch.
class CpuRingRotations final : public RingRotations {
 public:
  /// Uses the loops for `set`, which the CPU must support.
  explicit CpuRingRotations(std::shared_ptr<const RegionRings> rings,
                            InstructionSet set = available_instruction_sets().front());

  void set_rest_stretch(std::span<const Eigen::Matrix3d> stretch) override;
  void fit_rotations(std::span<const Eigen::Vector3d> displacement,
                     std::span<double> energies) override;
  void energy_gradient(std::span<double> g) override;
  std::vector<Eigen::Matrix3d> transforms() const override;

 private:
  void pack_batch(std::size_t batch);
  void fit(std::size_t batch_number, FitBatch& batch) const;

  const std::shared_ptr<const RegionRings> shared_rings_;
  const RegionRings& rings_ = *shared_rings_;
  const RingLoops& loops_;
  std::vector<FitRest> rest_;              ///< per batch of kFitLanes rows
  std::vector<FitStretch> stretch_;        ///< per batch; empty: all S_i are the identity
  std::vector<std::size_t> entry_starts_;  ///< first entry of each batch in entries_
  std::vector<FitEntries> entries_;
  /// Displacement of each vertex in the last fit; padded to full batches.
  std::vector<PaddedVector> displacement_;
  /// T_i - I of each vertex in the last fit; 0 if the vertex is not a row.
  std::vector<PaddedTurn> turns_;
  std::vector<PaddedVector> residuals_;  ///< om_i (L(v')_i - T_i delta_i), in the same order
};

}  // namespace lapwing
