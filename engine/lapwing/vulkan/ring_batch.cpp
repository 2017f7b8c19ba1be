#include "lapwing/vulkan/ring_batch.h"

#include <algorithm>
#include <cstdint>

#include "lapwing/gpu/recorder.h"

namespace lapwing {
namespace {

// 19 MB of blocks in float64: many rows per submission, yet far below every device's limits.
constexpr std::size_t kBlocksPerBatch = std::size_t{1} << 18U;

std::vector<RingBatch> split(const RingProblem& problem) {
  std::vector<RingBatch> batches;
  for (std::size_t r = 0; r < problem.rows.size(); ++r) {
    const std::size_t entries = problem.rings.size(problem.rows[r]);
    if (batches.empty() || batches.back().block_count() + 1 + entries > kBlocksPerBatch) {
      batches.push_back({r, 0, 0});
    }
    ++batches.back().row_count;
    batches.back().entry_count += entries;
  }
  return batches;
}

RingBatch largest_of(std::span<const RingBatch> batches) {
  RingBatch largest;
  for (const RingBatch& batch : batches) {
    largest.row_count = std::max(largest.row_count, batch.row_count);
    largest.entry_count = std::max(largest.entry_count, batch.entry_count);
  }
  return largest;
}

void upload_reals(VulkanState& state, const gpu::Buffer& buffer, std::span<const double> numbers) {
  if (state.float64) {
    state.transfer.upload(buffer, numbers);
  } else {
    const std::vector<float> rounded(numbers.begin(), numbers.end());
    state.transfer.upload(buffer, std::span<const float>(rounded));
  }
}

}  // namespace

std::size_t real_bytes(const VulkanState& state, std::size_t count) {
  return count * (state.float64 ? sizeof(double) : sizeof(float));
}

void download_reals(VulkanState& state, const gpu::Buffer& buffer, std::span<double> numbers) {
  if (state.float64) {
    state.transfer.download(buffer, numbers);
  } else {
    std::vector<float> values(numbers.size());
    state.transfer.download(buffer, std::span<float>(values));
    std::copy(values.begin(), values.end(), numbers.begin());
  }
}

// A position takes 3 doubles, or 3 floats and what each of them rounded off.
RingBatches::RingBatches(VulkanState& state, const RingProblem& problem)
    : state_(state),
      problem_(problem),
      batches_(split(problem)),
      largest_(largest_of(batches_)),
      positions_(*state.context, "positions", problem.positions.size() * 3 * sizeof(double)),
      rows_(*state.context, "rows", largest_.row_count * sizeof(std::uint32_t)),
      starts_(*state.context, "ring starts", (largest_.row_count + 1) * sizeof(std::uint32_t)),
      neighbours_(*state.context, "neighbours", largest_.entry_count * sizeof(std::uint32_t)),
      weights_(*state.context, "weights", real_bytes(state, largest_.entry_count)),
      commands_(*state.context, "one-rings") {
  if (!batches_.empty()) upload_positions();
}

void RingBatches::upload_positions() {
  if (state_.float64) {
    static_assert(sizeof(Eigen::Vector3d) == 3 * sizeof(double));
    state_.transfer.upload(positions_, problem_.positions);
    return;
  }
  std::vector<float> parts(problem_.positions.size() * 6);
  for (std::size_t v = 0; v < problem_.positions.size(); ++v) {
    // Number by number: of vectors g++ 12 drops the rounding to float and back, and with it all of
    // the low part.
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const double exact = problem_.positions[v][axis];
      const auto high = static_cast<float>(exact);
      float* const out = parts.data() + 6 * v + axis;
      out[0] = high;
      out[3] = static_cast<float>(exact - static_cast<double>(high));
    }
  }
  state_.transfer.upload(positions_, std::span<const float>(parts));
}

void RingBatches::upload_rows(const RingBatch& batch) {
  const auto rows = problem_.rows.subspan(batch.first_row, batch.row_count);
  std::vector<std::uint32_t> starts{0};
  std::vector<std::uint32_t> neighbours;
  std::vector<double> weights;
  starts.reserve(batch.row_count + 1);
  neighbours.reserve(batch.entry_count);
  weights.reserve(batch.entry_count);
  for (const Index i : rows) {
    const auto ring = problem_.rings[i];
    const auto row_weights = problem_.weights.subspan(problem_.rings.starts[i], ring.size());
    neighbours.insert(neighbours.end(), ring.begin(), ring.end());
    weights.insert(weights.end(), row_weights.begin(), row_weights.end());
    starts.push_back(static_cast<std::uint32_t>(neighbours.size()));
  }
  state_.transfer.upload(rows_, rows);
  state_.transfer.upload(starts_, std::span<const std::uint32_t>(starts));
  state_.transfer.upload(neighbours_, std::span<const std::uint32_t>(neighbours));
  upload_reals(state_, weights_, weights);
}

void RingBatches::run(const RingBatch& batch, const gpu::Kernel& kernel,
                      const gpu::Buffer& output) {
  upload_rows(batch);
  gpu::Recorder recorder(commands_);
  recorder.dispatch(kernel, batch.row_count,
                    {positions_, rows_, starts_, neighbours_, weights_, output},
                    static_cast<std::uint32_t>(batch.row_count));
  recorder.finish();
  commands_.run();
}

}  // namespace lapwing
