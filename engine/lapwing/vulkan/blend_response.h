#pragma once

#include <memory>
#include <span>
#include <vector>

#include "lapwing/gpu/context.h"
#include "lapwing/gpu/kernel.h"
#include "lapwing/gpu/recorder.h"
#include "lapwing/gpu/transfer.h"
#include "lapwing/kernels/kernels.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/vulkan/host_frame.h"

namespace lapwing {

/// Runs the kernel blend_response for the columns of one response, which are stored on the device
/// in float32. If the columns exceed the largest buffer, the vertices are split into ranges with
/// separate buffers. An object may be created on one thread and used on another.
class BlendResponse {
 public:
  /// A buffer contains at most `most_bytes` of columns; 0: the limit of the device. Throws GpuError
  /// if the columns do not fit in the device's memory.
  BlendResponse(std::shared_ptr<gpu::Context> context, gpu::Transfer& transfer,
                const ResponseColumns& columns, const Topology& topology,
                std::size_t most_bytes = 0);

  /// Creates the kernel to pass to `record`.
  static gpu::Kernel kernel(const gpu::Context& context);

  /// Sets the pose from which blends start: `rest` + `displacement`, relative to `origin`. Both
  /// lists have one vector per vertex of the mesh; an empty `displacement` is 0. Call this before
  /// the first blend. The device must have finished the recorded commands, as for `set_parameters`.
  void set_rest(gpu::Transfer& transfer, std::span<const Eigen::Vector3d> rest,
                std::span<const Eigen::Vector3d> displacement, const Eigen::Vector3d& origin);
  /// Sets the parameters for the next run of the recorded commands, one per column. Throws
  /// InputError if their number is wrong.
  void set_parameters(std::span<const double> parameters);

  /// Records the blend, which writes x, y and z of `positions`, a buffer with one vec4 per vertex
  /// of the mesh.
  void record(gpu::Recorder& recorder, const gpu::Kernel& kernel,
              const gpu::Buffer& positions) const;
  /// Does the work of the recorded commands immediately, on the CPU. All buffers must be mapped.
  void run_on_host(std::span<Vec4> positions) const;

  std::span<const Index> moving() const { return moving_; }
  /// Returns the vertices whose normals change: the moving vertices and their neighbours.
  const gpu::Buffer& affected() const { return affected_; }

 private:
  struct Range {
    std::size_t first;
    std::size_t count;
    gpu::Buffer moving;
    gpu::Buffer rests;
    gpu::Buffer columns;
  };
  void add_ranges(std::size_t most_bytes, gpu::Transfer& transfer);
  template <typename Pack>
  void fill(gpu::Transfer& transfer, const Pack& pack);
  void fill_columns(gpu::Transfer& transfer, std::span<const double> numbers);
  void fill_columns_along_axes(gpu::Transfer& transfer, std::span<const double> numbers);

  std::shared_ptr<gpu::Context> context_;
  std::size_t columns_;
  std::vector<Index> moving_;
  gpu::Buffer groups_;
  gpu::Buffer affected_;
  std::vector<Range> ranges_;
};

/// Uploads a response with a separate Transfer. May be called on any thread.
std::shared_ptr<BlendResponse> upload_response(const std::shared_ptr<gpu::Context>& context,
                                               const ResponseColumns& columns,
                                               const Topology& topology);

}  // namespace lapwing
