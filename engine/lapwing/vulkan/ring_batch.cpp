#include "lapwing/vulkan/ring_batch.h"

#include <algorithm>
#include <cstdint>

#include "lapwing/gpu/recorder.h"

namespace lapwing {
namespace {

// 19 MB of blocks in float64: many rows per submission, but far below the limits of every device.
constexpr std::size_t kBlocksPerBatch = std::size_t{1} << 18U;

std::vector<RingBatch> split(const RingProblem& problem) {
  return split_rows(problem.rows.size(),
                    [&](std::size_t r) { return problem.rings.size(problem.rows[r]); });
}

}  // namespace

std::vector<RingBatch> split_rows(std::size_t row_count,
                                  const std::function<std::size_t(std::size_t)>& entries_of) {
  std::vector<RingBatch> batches;
  for (std::size_t r = 0; r < row_count; ++r) {
    const std::size_t entries = entries_of(r);
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

RingBatches::RingBatches(VulkanState& state, const RingProblem& problem)
    : state_(state),
      problem_(problem),
      batches_(split(problem)),
      largest_(largest_of(batches_)),
      positions_(*state.context, "positions", VulkanState::place_bytes(problem.positions.size())),
      rows_(*state.context, "rows", largest_.row_count * sizeof(std::uint32_t)),
      starts_(*state.context, "ring starts", (largest_.row_count + 1) * sizeof(std::uint32_t)),
      neighbours_(*state.context, "neighbours", largest_.entry_count * sizeof(std::uint32_t)),
      weights_(*state.context, "weights", state.real_bytes(largest_.entry_count)),
      commands_(*state.context, "one-rings") {
  if (!batches_.empty()) state_.upload_places(positions_, problem.positions);
}

RingBatches::RingBatches(VulkanState& state, const EnergyProblem& problem)
    : RingBatches(state, problem.rings) {
  energy_ = &problem;
  energy_buffers_.emplace_back(*state.context, "weights of rows",
                               state.real_bytes(largest_.row_count));
  energy_buffers_.emplace_back(*state.context, "stiffness", state.real_bytes(largest_.entry_count));
}

void RingBatches::upload_energy(const RingBatch& batch) {
  std::vector<double> row_weights;
  std::vector<double> stiffness;
  row_weights.reserve(batch.row_count);
  stiffness.reserve(batch.entry_count);
  for (const Index i : problem_.rows.subspan(batch.first_row, batch.row_count)) {
    row_weights.push_back(energy_->row_weights[i]);
    const auto own = energy_->stiffness.subspan(problem_.rings.starts[i], problem_.rings.size(i));
    stiffness.insert(stiffness.end(), own.begin(), own.end());
  }
  state_.upload_reals(energy_buffers_[0], row_weights);
  state_.upload_reals(energy_buffers_[1], stiffness);
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
  state_.transfer.upload(starts_, starts);
  state_.transfer.upload(neighbours_, neighbours);
  state_.upload_reals(weights_, weights);
}

void RingBatches::assemble(const gpu::Kernel& kernel, const char* name, std::span<double> blocks) {
  constexpr std::size_t kNumbersPerBlock = 9;
  const gpu::Buffer output(*state_.context, name,
                           state_.real_bytes(kNumbersPerBlock * largest_.block_count()));
  std::size_t written = 0;
  for (const RingBatch& batch : batches_) {
    run(batch, kernel, output);
    const std::size_t numbers = kNumbersPerBlock * batch.block_count();
    state_.download_reals(output, blocks.subspan(written, numbers));
    written += numbers;
  }
}

void RingBatches::run(const RingBatch& batch, const gpu::Kernel& kernel,
                      const gpu::Buffer& output) {
  upload_rows(batch);
  std::vector<gpu::BufferRange> buffers{positions_, rows_, starts_, neighbours_, weights_, output};
  if (energy_ != nullptr) {
    upload_energy(batch);
    buffers.insert(buffers.end(), energy_buffers_.begin(), energy_buffers_.end());
  }
  const auto count = static_cast<std::uint32_t>(batch.row_count);
  gpu::Recorder recorder(commands_);
  recorder.dispatch(kernel, count, buffers, std::as_bytes(std::span(&count, 1)));
  recorder.finish();
  commands_.run();
}

}  // namespace lapwing
