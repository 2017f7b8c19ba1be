#include "lapwing/vulkan/vulkan_kernels.h"

#include <type_traits>
#include <utility>

#include "lapwing/base/errors.h"
#include "lapwing/vulkan/mapped_batch.h"
#include "lapwing/vulkan/ring_batch.h"
#include "lapwing/vulkan/vulkan_drag_frame.h"
#include "lapwing/vulkan/vulkan_ring_rotations.h"
#include "lapwing/vulkan/vulkan_state.h"

namespace lapwing {
namespace {

bool choose_float64(const gpu::Context& context, Precision precision) {
  const bool available = context.description().float64;
  if (precision == Precision::float64 && !available) {
    throw GpuError(context.description().name +
                   " does not support float64 (shaderFloat64); choose the precision float32 or "
                   "another device");
  }
  return available && precision != Precision::float32;
}

DeviceInfo describe(const VulkanState& state) {
  const gpu::DeviceDescription& device = state.context->description();
  return {device.name, device.type, device.driver, state.float64, state.frames};
}

// Views a list of vectors or matrices as one list of numbers.
template <typename Matrix>
auto numbers_of(std::span<Matrix> matrices) {
  using Number = std::conditional_t<std::is_const_v<Matrix>, const double, double>;
  return std::span<Number>(matrices.empty() ? nullptr : matrices.data()->data(),
                           matrices.size() * Matrix::SizeAtCompileTime);
}

// Returns the edges of the target, computed in double precision. They replace the target's
// positions in the kernel.
std::vector<Eigen::Vector3d> target_edges(const RegionRings& rings, const RingBatch& batch,
                                          std::span<const Eigen::Vector3d> positions) {
  std::vector<Eigen::Vector3d> edges;
  edges.reserve(batch.entry_count);
  for (std::size_t r = batch.first_row; r < batch.first_row + batch.row_count; ++r) {
    for (std::size_t e = rings.starts[r]; e < rings.starts[r + 1]; ++e) {
      edges.emplace_back(positions[rings.neighbours[e]] - positions[r]);
    }
  }
  return edges;
}

}  // namespace

std::shared_ptr<const VulkanPrograms> compile_kernels(std::shared_ptr<gpu::Context> context,
                                                      Precision precision) {
  const bool float64 = choose_float64(*context, precision);
  return std::make_shared<VulkanPrograms>(std::move(context), float64);
}

VulkanKernels::VulkanKernels(const VulkanOptions& options)
    : VulkanKernels(std::make_shared<gpu::Context>(), Precision::automatic,
                    options.frames_on_device) {}

VulkanKernels::VulkanKernels(std::shared_ptr<gpu::Context> context, Precision precision,
                             bool frames_on_device)
    : VulkanKernels(compile_kernels(std::move(context), precision), frames_on_device) {}

VulkanKernels::VulkanKernels(std::shared_ptr<const VulkanPrograms> programs, bool frames_on_device)
    : state_(std::make_shared<VulkanState>(std::move(programs), frames_on_device)),
      device_(describe(*state_)) {}

VulkanKernels::~VulkanKernels() = default;

void VulkanKernels::assemble_rsi(const RingProblem& problem, std::span<double> blocks) {
  RingBatches(*state_, problem).assemble(state_->programs->assemble_rsi, "RSI blocks", blocks);
}

void VulkanKernels::assemble_tangent(const EnergyProblem& problem, std::span<double> blocks) {
  RingBatches(*state_, problem)
      .assemble(state_->programs->assemble_tangent, "tangent blocks", blocks);
}

void VulkanKernels::sample_laplacians(const RingProblem& problem,
                                      std::span<Eigen::Vector3d> laplacians) {
  VulkanState& state = *state_;
  RingBatches rings(state, problem);
  const gpu::Buffer output(*state.context, "Laplacians",
                           state.real_bytes(3 * rings.largest().row_count));
  for (const RingBatch& batch : rings.batches()) {
    rings.run(batch, state.programs->sample_laplacians, output);
    state.download_reals(output, numbers_of(laplacians.subspan(batch.first_row, batch.row_count)));
  }
}

void VulkanKernels::sample_mapped_laplacians(const MappedRings& rings, MappedSampling sampling,
                                             std::span<const Eigen::Vector3d> source,
                                             std::span<Eigen::Vector3d> laplacians) {
  VulkanState& state = *state_;
  MappedBatches mapped(state, rings, source);
  const RingBatch& largest = mapped.largest();
  const gpu::Buffer weights(*state.context, "weights", state.real_bytes(largest.entry_count));
  const gpu::Buffer output(*state.context, "Laplacians", state.real_bytes(3 * largest.row_count));
  for (const RingBatch& batch : mapped.batches()) {
    const auto all_weights = std::span(rings.target.weights);
    state.upload_reals(weights, all_weights.subspan(mapped.first_entry(batch), batch.entry_count));
    mapped.run(batch, state.programs->sample_mapped_laplacians, {weights, output},
               sampling == MappedSampling::linear);
    state.download_reals(output, numbers_of(laplacians.subspan(batch.first_row, batch.row_count)));
  }
}

void VulkanKernels::rotate_frames(const MappedRings& rings, const FramedSurface& source,
                                  const FramedSurface& target,
                                  std::span<Eigen::Matrix3d> transforms) {
  VulkanState& state = *state_;
  MappedBatches mapped(state, rings, source.positions);
  const RingBatch& largest = mapped.largest();
  const auto reals = [&](const char* name, std::size_t count) {
    return gpu::Buffer(*state.context, name, state.real_bytes(count));
  };
  const gpu::Buffer edges = reals("target edges", 3 * largest.entry_count);
  const gpu::Buffer source_normals = reals("source normals", 3 * source.normals.size());
  const gpu::Buffer target_normals = reals("target normals", 3 * largest.row_count);
  const gpu::Buffer output = reals("frames", 9 * largest.row_count);
  if (!mapped.batches().empty()) state.upload_reals(source_normals, numbers_of(source.normals));
  for (const RingBatch& batch : mapped.batches()) {
    const auto own_edges = target_edges(rings.target, batch, target.positions);
    state.upload_reals(edges, numbers_of(std::span(own_edges)));
    state.upload_reals(target_normals,
                       numbers_of(target.normals.subspan(batch.first_row, batch.row_count)));
    mapped.run(batch, state.programs->rotate_frames,
               {edges, source_normals, target_normals, output});
    state.download_reals(output, numbers_of(transforms.subspan(batch.first_row, batch.row_count)));
  }
}

std::unique_ptr<VulkanDragFrame> VulkanKernels::make_drag_frame(
    std::shared_ptr<const DragFrameProblem> problem) {
  return std::make_unique<VulkanDragFrame>(state_, std::move(problem));
}

std::unique_ptr<RingRotations> VulkanKernels::make_ring_rotations(
    std::shared_ptr<const RegionRings> rings) {
  return std::make_unique<VulkanRingRotations>(state_, *rings);
}

const std::shared_ptr<gpu::Context>& VulkanKernels::context() const {
  return state_->context;
}

}  // namespace lapwing
