#include "lapwing/vulkan/mapped_batch.h"

#include "lapwing/gpu/recorder.h"

namespace lapwing {
namespace {

// Push constants of shaders/mapped_ring.glsl.
struct Push {
  std::uint32_t row_count;
  std::uint32_t first_row;
  std::uint32_t flag;
};

std::vector<RingBatch> split(const RegionRings& rings) {
  return split_rows(rings.row_count(), [&](std::size_t r) -> std::size_t {
    return rings.starts[r + 1] - rings.starts[r];
  });
}

}  // namespace

MappedBatches::MappedBatches(VulkanState& state, const MappedRings& rings,
                             std::span<const Eigen::Vector3d> source)
    : state_(state),
      rings_(rings),
      batches_(split(rings.target)),
      largest_(largest_of(batches_)),
      source_(*state.context, "source", VulkanState::place_bytes(source.size())),
      corners_(*state.context, "corners", 3 * rings.points.size() * sizeof(std::uint32_t)),
      point_weights_(*state.context, "weights of corners",
                     state.real_bytes(3 * rings.points.size())),
      starts_(*state.context, "ring starts", (largest_.row_count + 1) * sizeof(std::uint32_t)),
      neighbours_(*state.context, "neighbours", largest_.entry_count * sizeof(std::uint32_t)),
      commands_(*state.context, "mapped one-rings") {
  if (batches_.empty()) return;
  state_.upload_places(source_, source);
  upload_points();
}

void MappedBatches::upload_points() {
  std::vector<std::uint32_t> corners;
  std::vector<double> weights;
  corners.reserve(3 * rings_.points.size());
  weights.reserve(3 * rings_.points.size());
  for (const SurfacePoint& point : rings_.points) {
    corners.insert(corners.end(), point.corners.begin(), point.corners.end());
    weights.insert(weights.end(), point.weights.begin(), point.weights.end());
  }
  state_.transfer.upload(corners_, corners);
  state_.upload_reals(point_weights_, weights);
}

void MappedBatches::upload_rings(const RingBatch& batch) {
  const std::size_t first = first_entry(batch);
  const auto own_starts = std::span(rings_.target.starts).subspan(batch.first_row);
  std::vector<std::uint32_t> starts;
  starts.reserve(batch.row_count + 1);
  for (std::size_t r = 0; r <= batch.row_count; ++r) {
    starts.push_back(static_cast<std::uint32_t>(own_starts[r] - first));
  }
  state_.transfer.upload(starts_, starts);
  state_.transfer.upload(neighbours_,
                         std::span(rings_.target.neighbours).subspan(first, batch.entry_count));
}

void MappedBatches::run(const RingBatch& batch, const gpu::Kernel& kernel,
                        std::initializer_list<gpu::BufferRange> others, bool flag) {
  upload_rings(batch);
  std::vector<gpu::BufferRange> buffers{source_, corners_, point_weights_, starts_, neighbours_};
  buffers.insert(buffers.end(), others);
  const Push push{static_cast<std::uint32_t>(batch.row_count),
                  static_cast<std::uint32_t>(batch.first_row), flag ? 1U : 0U};
  gpu::Recorder recorder(commands_);
  recorder.dispatch(kernel, batch.row_count, buffers, std::as_bytes(std::span(&push, 1)));
  recorder.finish();
  commands_.run();
}

}  // namespace lapwing
