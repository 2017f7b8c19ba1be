#pragma once

#include <functional>
#include <memory>

#include "lapwing/kernels/kernels.h"

namespace lapwing {

/// The kernels of a device that may fail. If a call fails with GpuError (device lost or out of
/// memory), the CPU twin repeats it and runs all later calls. No data are lost, and the results are
/// within the tolerance of the twins. `device()` then describes the CPU and names the failed
/// device.
///
/// For this purpose, its ring rotations store the rings and the last displacement, which takes 300
/// bytes per vertex of the region. The ring rotations may outlive this object. Not thread-safe.
class FallbackKernels final : public Kernels {
 public:
  /// If `make` throws GpuError, all calls run on the CPU.
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
