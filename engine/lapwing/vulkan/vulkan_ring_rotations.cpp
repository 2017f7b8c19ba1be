#include "lapwing/vulkan/vulkan_ring_rotations.h"

#include <algorithm>
#include <utility>

#include <Eigen/Geometry>

#include "lapwing/gpu/context.h"

namespace lapwing {
namespace {

// Flags of shaders/rotations.glsl.
constexpr std::uint32_t kStiffness = 1;
constexpr std::uint32_t kStretch = 2;
constexpr std::size_t kStretchNumbers = 6;

// Returns the end of the longest range of rows that begins at `first` and has at most `most`
// entries. The range has at least one row.
std::size_t end_of_range(const RegionRings& rings, std::size_t first, std::size_t most) {
  std::size_t last = first + 1;
  while (last < rings.row_count() && rings.starts[last + 1] - rings.starts[first] <= most) ++last;
  return last;
}

}  // namespace

VulkanRingRotations::VulkanRingRotations(std::shared_ptr<VulkanState> state,
                                         const RegionRings& rings, std::size_t most_entries)
    : state_(std::move(state)),
      row_count_(rings.row_count()),
      row_weights_(*state_->context, "weights of rows", state_->real_bytes(row_count_)),
      stretch_(*state_->context, "rest stretch", state_->real_bytes(kStretchNumbers)),
      displacement_(*state_->context, "displacements",
                    VulkanState::place_bytes(rings.vertices.size())),
      turns_(*state_->context, "rotations of rings", state_->real_bytes(4 * row_count_)),
      residuals_(*state_->context, "residuals of Laplacians", state_->real_bytes(3 * row_count_)),
      energies_(*state_->context, "energies of rings", state_->real_bytes(row_count_)),
      result_(*state_->context, "gradient", state_->real_bytes(3 * rings.unknown_rows.size())),
      fit_rotations_(*state_->context, "fit rotations"),
      energy_gradient_(*state_->context, "energy gradient") {
  if (most_entries == 0) {
    most_entries = state_->context->limits().maxStorageBufferRange / state_->real_bytes(3);
  }
  const std::uint32_t flags = rings.stiffness.empty() ? 0 : kStiffness;
  const std::vector<Index> unknown_of_row = inverse_index(rings.unknown_rows, rings.row_count());
  for (std::size_t first = 0; first < row_count_;) {
    const std::size_t last = end_of_range(rings, first, most_entries);
    add_range(rings, first, last, unknown_of_row, flags);
    first = last;
  }
  if (row_count_ > 0) state_->upload_reals(row_weights_, rings.row_weights);
  record_lists();
}

void VulkanRingRotations::set_rest_stretch(std::span<const Eigen::Matrix3d> stretch) {
  const bool changes_kind = stretch.empty() != rest_stretch_.empty();
  rest_stretch_.assign(stretch.begin(), stretch.end());
  if (changes_kind) {
    const std::size_t rows = std::max<std::size_t>(stretch.size(), 1);
    stretch_ =
        gpu::Buffer(*state_->context, "rest stretch", state_->real_bytes(kStretchNumbers * rows));
    for (Range& range : ranges_) range.push.flags ^= kStretch;
    record_lists();
  }
  if (stretch.empty()) return;
  std::vector<double> numbers;
  numbers.reserve(kStretchNumbers * stretch.size());
  for (const Eigen::Matrix3d& S : stretch) {
    numbers.insert(numbers.end(),
                   {S(0, 0) - 1.0, S(1, 1) - 1.0, S(2, 2) - 1.0, S(1, 2), S(0, 2), S(0, 1)});
  }
  state_->upload_reals(stretch_, numbers);
}

void VulkanRingRotations::add_range(const RegionRings& rings, std::size_t first, std::size_t last,
                                    std::span<const Index> unknown_of_row, std::uint32_t flags) {
  VulkanState& state = *state_;
  const gpu::Context& context = *state.context;
  const std::size_t begin = rings.starts[first];
  const std::size_t entries = rings.starts[last] - begin;
  const std::size_t rows = last - first;
  const bool stiff = !rings.stiffness.empty();
  const auto words = [](std::size_t count) { return count * sizeof(std::uint32_t); };
  ranges_.push_back({{static_cast<std::uint32_t>(rows), static_cast<std::uint32_t>(first),
                      static_cast<std::uint32_t>(row_count_),
                      static_cast<std::uint32_t>(rings.unknown_rows.size()), flags},
                     gpu::Buffer(context, "ring starts", words(rows + 1)),
                     gpu::Buffer(context, "neighbours", words(entries)),
                     gpu::Buffer(context, "rest edges", state.real_bytes(3 * entries)),
                     gpu::Buffer(context, "weights", state.real_bytes(entries)),
                     gpu::Buffer(context, "reverse weights", state.real_bytes(entries)),
                     gpu::Buffer(context, "stiffness", state.real_bytes(stiff ? entries : 0)),
                     gpu::Buffer(context, "unknowns", words(rows))});
  const Range& range = ranges_.back();
  std::vector<Index> starts(rings.starts.begin() + static_cast<std::ptrdiff_t>(first),
                            rings.starts.begin() + static_cast<std::ptrdiff_t>(last + 1));
  for (Index& start : starts) start -= static_cast<Index>(begin);
  state.transfer.upload(range.starts, starts);
  state.transfer.upload(range.neighbours, std::span(rings.neighbours).subspan(begin, entries));
  state.transfer.upload(range.unknowns, unknown_of_row.subspan(first, rows));
  if (entries == 0) return;
  state.upload_reals(range.edges, {rings.edges[begin].data(), 3 * entries});
  state.upload_reals(range.weights, std::span(rings.weights).subspan(begin, entries));
  state.upload_reals(range.reverse_weights,
                     std::span(rings.reverse_weights).subspan(begin, entries));
  if (stiff)
    state.upload_reals(range.stiffness, std::span(rings.stiffness).subspan(begin, entries));
}

void VulkanRingRotations::record_lists() {
  gpu::Recorder fit(fit_rotations_);
  record_fit_rotations(fit, displacement_);
  fit.finish();
  gpu::Recorder gather(energy_gradient_);
  record_energy_gradient(gather, displacement_);
  gather.finish();
}

void VulkanRingRotations::record(gpu::Recorder& recorder, const gpu::Buffer& displacement) const {
  record_fit_rotations(recorder, displacement);
  record_energy_gradient(recorder, displacement);
}

void VulkanRingRotations::record_fit_rotations(gpu::Recorder& recorder,
                                               const gpu::Buffer& displacement) const {
  for (const Range& range : ranges_) {
    recorder.dispatch(state_->programs->fit_rotations, range.push.row_count,
                      {displacement, range.starts, range.neighbours, range.edges, range.weights,
                       range.stiffness, row_weights_, turns_, residuals_, energies_, stretch_},
                      range.push);
  }
}

void VulkanRingRotations::fit_rotations(std::span<const Eigen::Vector3d> displacement,
                                        std::span<double> energies) {
  if (row_count_ == 0) return;
  state_->upload_places(displacement_, displacement);
  fit_rotations_.run();
  state_->download_reals(energies_, energies);
}

void VulkanRingRotations::record_energy_gradient(gpu::Recorder& recorder,
                                                 const gpu::Buffer& displacement) const {
  for (const Range& range : ranges_) {
    recorder.dispatch(
        state_->programs->energy_gradient, range.push.row_count,
        {displacement, residuals_, turns_, range.unknowns, range.starts, range.neighbours,
         range.edges, range.reverse_weights, range.stiffness, result_, stretch_},
        range.push);
  }
}

void VulkanRingRotations::energy_gradient(std::span<double> g) {
  if (g.empty()) return;
  energy_gradient_.run();
  state_->download_reals(result_, g);
}

std::vector<Eigen::Matrix3d> VulkanRingRotations::transforms() const {
  std::vector<double> numbers(4 * row_count_);
  state_->download_reals(turns_, numbers);
  std::vector<Eigen::Matrix3d> transforms;
  for (std::size_t r = 0; r < row_count_; ++r) {
    const Eigen::Map<const Eigen::Vector4d> q(numbers.data() + 4 * r);
    transforms.emplace_back(
        Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix());
    if (!rest_stretch_.empty()) transforms.back() *= rest_stretch_[r];
  }
  return transforms;
}

}  // namespace lapwing
