#pragma once

#include <functional>
#include <memory>

#include "lapwing/kernels/kernels.h"

namespace lapwing {

/// The kernels of a device that may fail. If a call fails (GpuError: lost, or out of memory), the
/// CPU twin repeats it and runs all later ones. The caller loses nothing, and results stay within
/// the tolerance of the twins. `device()` is then the CPU, and says which device failed.
///
/// For this, its ring rotations keep the rings and the last displacement: 300 bytes per vertex of
/// the region. They may outlive the object. Not thread-safe.
class FallbackKernels final : public Kernels {
 public:
  /// If `make` throws GpuError, the CPU does everything.
  explicit FallbackKernels(const std::function<std::unique_ptr<Kernels>()>& make);

  const DeviceInfo& device() const override;
  void assemble_rsi(const RingProblem& problem, std::span<double> blocks) override;
  void assemble_tangent(const EnergyProblem& problem, std::span<double> blocks) override;
  void sample_laplacians(const RingProblem& problem,
                         std::span<Eigen::Vector3d> laplacians) override;
  void sample_mapped_laplacians(const MappedRings& rings, MappedSampling sampling,
                                std::span<const Eigen::Vector3d> source,
                                std::span<Eigen::Vector3d> laplacians) override;
  void rotate_frames(const MappedRings& rings, const FramedSurface& source,
                     const FramedSurface& target, std::span<Eigen::Matrix3d> transforms) override;
  std::unique_ptr<RingRotations> make_ring_rotations(
      std::shared_ptr<const RegionRings> rings) override;

 private:
  class Devices;
  class Rotations;
  std::shared_ptr<Devices> devices_;
};

}  // namespace lapwing
