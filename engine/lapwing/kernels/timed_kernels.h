#pragma once

#include <memory>
#include <string>
#include <vector>

#include "lapwing/kernels/kernels.h"

namespace lapwing {

/// Counts the calls of one kernel on one device, and adds up their times.
struct KernelTime {
  std::string kernel;
  std::string device;  ///< DeviceInfo::name
  std::size_t calls = 0;
  double milliseconds = 0.0;  ///< wall time, including packing and copying
};

/// Forwards every call to `kernels` and measures its time. Not thread-safe. `kernels` must
/// outlive this object, and this object must outlive its ring rotations.
class TimedKernels final : public Kernels {
 public:
  explicit TimedKernels(Kernels& kernels) : kernels_(kernels) {}

  /// Returns one entry per kernel and device, in the order of their first calls.
  const std::vector<KernelTime>& times() const { return times_; }

  const DeviceInfo& device() const override { return kernels_.device(); }
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
  class Rotations;
  template <class Call>
  void time(const char* kernel, const Call& call);

  Kernels& kernels_;
  std::vector<KernelTime> times_;
};

}  // namespace lapwing
