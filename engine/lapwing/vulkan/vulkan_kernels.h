#pragma once

#include <memory>

#include "lapwing/kernels/kernels.h"

namespace lapwing {

namespace gpu {
class Context;
}
class VulkanDragFrame;
class VulkanState;
struct DragFrameProblem;

/// The compiled shaders of the kernels on a device. Any number of VulkanKernels on any threads may
/// share them.
struct VulkanPrograms;

/// The precision of the kernels. Those of drawn surfaces always use float32.
enum class Precision {
  automatic,  ///< float64 if the device supports it
  float32,
  float64,  ///< throws GpuError if the device does not support it
};

/// Compiles the shaders. On a software device, this takes a few tenths of a second. Throws
/// GpuError.
std::shared_ptr<const VulkanPrograms> compile_kernels(std::shared_ptr<gpu::Context> context,
                                                      Precision precision);

struct VulkanOptions {
  /// If true, shaders minimize the energy even on a software device (DeviceInfo::frames).
  bool frames_on_device = false;
};

/// The kernels as Vulkan compute shaders. Not thread-safe.
class VulkanKernels final : public Kernels {
 public:
  /// Opens the best device for `options`. Throws GpuError if no device is suitable. The message
  /// lists the devices that were tried and the packages to install.
  explicit VulkanKernels(const VulkanOptions& options = {});
  /// Uses a context that other objects, such as a window, may also use.
  VulkanKernels(std::shared_ptr<gpu::Context> context, Precision precision,
                bool frames_on_device = false);
  explicit VulkanKernels(std::shared_ptr<const VulkanPrograms> programs,
                         bool frames_on_device = false);
  ~VulkanKernels() override;

  const DeviceInfo& device() const override { return device_; }
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
  std::unique_ptr<VulkanDragFrame> make_drag_frame(std::shared_ptr<const DragFrameProblem> problem);

  const std::shared_ptr<gpu::Context>& context() const;

 private:
  std::shared_ptr<VulkanState> state_;
  DeviceInfo device_;
};

}  // namespace lapwing
