#pragma once

#include <cstdint>
#include <vector>

#include "lapwing/kernels/fit_batch.h"
#include "lapwing/kernels/kernels.h"

namespace lapwing {

/// RingRotations in double precision, on all threads. Allocates nothing after construction.
class CpuRingRotations final : public RingRotations {
 public:
  CpuRingRotations(const RegionRings& rings, RingMotion motion);

  void fit_rotations(std::span<const Eigen::Vector3d> displacement,
                     std::span<double> energies) override;
  void rotate_laplacians(std::span<double> b) override;
  std::vector<Eigen::Matrix3d> transforms() const override;

 private:
  using Vector4 = Eigen::Vector4d;

  // The transforms of kFitLanes rows, as in FitBatch.
  struct Transforms {
    double entries[9][kFitLanes];
  };

  void pack_batch(std::size_t batch);
  void fit_lane(const FitRest& rest, FitBatch& batch, int lane) const;
  void fit(std::size_t batch_number, FitBatch& batch) const;
  Eigen::Matrix3d transform(std::size_t row) const;
  double edge_energy(std::size_t row) const;
  Eigen::Vector3d edge_forces(std::size_t row) const;

  RegionRings rings_;
  RingMotion motion_;
  FitBatchFunction fit_batch_;
  std::vector<FitRest> rest_;              ///< per batch of kFitLanes rows
  std::vector<std::size_t> entry_starts_;  ///< per batch, in entries_
  std::vector<FitEntries> entries_;
  std::vector<Vector4> displacement_;   ///< per vertex, of the last fit; no fewer than lanes
  std::vector<Transforms> transforms_;  ///< per batch, where edges resist; else empty
  std::vector<Vector4> turned_;  ///< per vertex: T_i delta_i - delta_i, 0 for one that is no row
};

}  // namespace lapwing
