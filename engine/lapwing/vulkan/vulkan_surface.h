#pragma once

#include <memory>

#include "lapwing/gpu/buffer.h"
#include "lapwing/gpu/command_list.h"
#include "lapwing/kernels/kernels.h"

namespace lapwing {

class VulkanState;

/// Device time in milliseconds, the processor's where that does the work; 0 on a device without
/// timestamps.
struct SurfaceTimes {
  double blend_ms = 0.0;
  double normals_ms = 0.0;
};

/// A deformed surface in device memory, in float32. The renderer draws from its buffers, without a
/// copy, once `blend` or `place` has returned. On a software device the processor does in the same
/// memory what the shaders would (vulkan/host_frame.h), unless that memory is not mapped.
class VulkanSurface final : public DeformedSurface {
 public:
  VulkanSurface(std::shared_ptr<VulkanState> state, const SurfaceInput& input);
  ~VulkanSurface() override;

  void set_basis(std::span<const double> basis) override;
  void set_axis_basis(std::span<const double> numbers) override;
  void set_rest(std::span<const Eigen::Vector3d> positions) override;
  void blend(std::span<const double> parameters) override;
  void place(std::span<const Eigen::Vector3d> positions) override;
  Positions positions() const override;
  std::vector<Eigen::Vector3d> normals() const override;

  /// Of all calls of `blend` and `place` since this was last called.
  SurfaceTimes take_times();

  gpu::Context& context() const;
  std::size_t vertex_count() const { return vertex_count_; }
  std::size_t triangle_count() const { return triangle_count_; }
  /// What was subtracted from the positions: the centre of the rest shape's bounding box. Float32
  /// positions then keep their digits wherever the mesh lies.
  const Eigen::Vector3d& origin() const { return origin_; }
  /// One vec4 per vertex: the position relative to `origin()`, and 1.
  const gpu::Buffer& position_buffer() const;
  /// One vec4 per vertex: the unit normal, or zero, and 0.
  const gpu::Buffer& normal_buffer() const;
  /// Three uint per triangle.
  const gpu::Buffer& triangle_buffer() const;

 private:
  struct Buffers;

  void upload_positions(std::span<const Eigen::Vector3d> positions);
  void upload_rest(const SurfaceInput& input);
  void record_frame();
  void record_normals();
  void renew_normals();

  std::shared_ptr<VulkanState> state_;
  std::size_t vertex_count_;
  std::size_t triangle_count_;
  Eigen::Vector3d origin_;
  std::unique_ptr<Buffers> buffers_;
  bool on_host_;                               ///< whether the processor does the frames
  std::unique_ptr<gpu::CommandList> frame_;    ///< of a blend; null on the host, as the next
  std::unique_ptr<gpu::CommandList> normals_;  ///< after a placing
  SurfaceTimes times_;
};

}  // namespace lapwing
