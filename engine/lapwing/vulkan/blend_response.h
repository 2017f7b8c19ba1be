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

/// Kernel blend_response over the columns of one response, stored on the device in float32. If the
/// columns exceed the largest buffer, the vertices are split into ranges with separate buffers. May
/// be created on another thread than it is used on.
class BlendResponse {
 public:
  /// One buffer has at most `most_bytes` of columns; the device's limit if 0. Throws GpuError if
  /// the columns do not fit in the device's memory.
  BlendResponse(std::shared_ptr<gpu::Context> context, gpu::Transfer& transfer,
                const ResponseColumns& columns, const Topology& topology,
                std::size_t most_bytes = 0);

  /// Returns the pipeline that `record` runs.
  static gpu::Kernel kernel(const gpu::Context& context);

  /// Sets the start of the blends: the moving vertices at `rest` + `displacement`, both of the
  /// whole mesh, relative to `origin`. An empty `displacement` is 0. Required before the first
  /// blend. The device must have finished the recorded commands, as for `set_parameters`.
  void set_rest(gpu::Transfer& transfer, std::span<const Eigen::Vector3d> rest,
                std::span<const Eigen::Vector3d> displacement, const Eigen::Vector3d& origin);
  /// Sets the parameters of the next run of the recorded commands, one per column. Throws
  /// InputError if their number is wrong.
  void set_parameters(std::span<const double> parameters);

  /// Records the blend into `positions`, one vec4 per vertex of the mesh. w stays 1.
  void record(gpu::Recorder& recorder, const gpu::Kernel& kernel,
              const gpu::Buffer& positions) const;
  /// Does the same as the recorded commands, at once on the CPU. All buffers must be mapped.
  void run_on_host(std::span<Vec4> positions) const;

  std::span<const Index> moving() const { return moving_; }
  /// The vertices whose normals change: the moving ones and their neighbours.
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

/// Uploads a response with its own Transfer, on any thread.
std::shared_ptr<BlendResponse> upload_response(const std::shared_ptr<gpu::Context>& context,
                                               const ResponseColumns& columns,
                                               const Topology& topology);

}  // namespace lapwing
