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

  void fit_lane(FitBatch& batch, int lane) const;
  void fit_rows(std::size_t first, int count, std::span<double> energies);
  Eigen::Matrix3d transform(std::size_t row) const;
  double edge_energy(std::size_t row) const;
  Eigen::Vector3d edge_forces(std::size_t row) const;

  RegionRings rings_;
  RingMotion motion_;
  FitBatchFunction fit_batch_;
  std::vector<Vector4> edges_;         ///< per entry: v_j - v_i at rest, w_ij
  std::vector<Vector4> displacement_;  ///< per vertex
  std::vector<Transforms> transforms_;
  std::vector<Vector4> turned_;  ///< per row: T_i delta_i - delta_i
};

}  // namespace lapwing
