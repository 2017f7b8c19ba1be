#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "lapwing/elastic/drag_frame.h"
#include "lapwing/gpu/buffer.h"
#include "lapwing/gpu/recorder.h"
#include "lapwing/vulkan/vulkan_ring_rotations.h"

namespace lapwing {

/// Computes drag frames on the device, in the precision of its kernels. A frame is part of the
/// commands that draw it, so it takes one submission and no result returns to the CPU. Needs about
/// 380 bytes of device memory per vertex in float32.
class VulkanDragFrame {
 public:
  /// Throws GpuError if the problem does not fit in the device's memory or in its largest buffer.
  VulkanDragFrame(std::shared_ptr<VulkanState> state,
                  std::shared_ptr<const DragFrameProblem> problem);

  /// Sets the displacements from which the next frame starts, one per vertex. The device must have
  /// finished all frames.
  void begin(std::span<const Eigen::Vector3d> displacement);

  /// Uploads the input of the next frame. The device must have finished the frame before the last
  /// one.
  void set_input(const DragFrameInput& input);
  /// Records the next frame.
  void record(gpu::Recorder& recorder);
  /// Records the positions of DragFrameProblem::vertices after the last recorded frame. `positions`
  /// has one vec4 per vertex of the mesh, relative to `origin`; w does not change.
  void record_positions(gpu::Recorder& recorder, const Eigen::Vector3d& origin,
                        const gpu::Buffer& positions) const;

  /// Returns the displacements of the last frame, one per vertex. The device must have finished it.
  std::vector<Eigen::Vector3d> displacement() const;

  const std::shared_ptr<const DragFrameProblem>& problem() const { return problem_; }

 private:
  struct Input {
    gpu::Buffer motions;
    gpu::Buffer prescribed;
  };
  gpu::Buffer make_places() const;
  Input make_input() const;
  void write(const gpu::Buffer& buffer, std::span<const double> numbers) const;

  std::shared_ptr<VulkanState> state_;
  std::shared_ptr<const DragFrameProblem> problem_;
  std::uint32_t vertex_count_;
  VulkanRingRotations rotations_;
  /// Displacements. A frame reads one buffer and writes the others in turn.
  std::array<gpu::Buffer, 3> places_;
  std::size_t now_ = 0;          ///< index in `places_` of the last frame's result
  std::array<Input, 2> inputs_;  ///< used in turn
  std::size_t input_ = 0;        ///< index in `inputs_` of the next frame's input
  gpu::Buffer rest_;
  gpu::Buffer nodes_;
  gpu::Buffer entries_;
  gpu::Buffer stiffness_;
  gpu::Buffer unknowns_;
  gpu::Buffer inverse_diagonal_;
  gpu::Buffer vertices_;
};

}  // namespace lapwing
