#include "lapwing/vulkan/vulkan_drag_frame.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lapwing/gpu/context.h"

namespace lapwing {
namespace {

// Push constants of the shaders of the same names.
struct ProlongatePush {
  std::uint32_t vertex_count;
  std::uint32_t exact_count;
};
struct SmoothPush {
  std::uint32_t vertex_count;
  std::uint32_t unknown_count;
  float step;
  float momentum;
};
struct ShowPush {
  std::uint32_t vertex_count;
  std::array<float, 3> origin;
};

std::span<const double> numbers_of(std::span<const Eigen::Vector3d> vectors) {
  return {vectors.empty() ? nullptr : vectors.front().data(), 3 * vectors.size()};
}

// Returns the nodes in the format of shaders/prolongate.comp, those with weights first.
std::vector<std::uint32_t> packed_nodes(std::span<const EmbeddedVertex> embedded) {
  std::vector<std::uint32_t> packed(kEmbeddingNodes * embedded.size(), 0);
  for (std::size_t v = 0; v < embedded.size(); ++v) {
    std::size_t count = 0;
    for (std::size_t node = 0; node < kEmbeddingNodes; ++node) {
      const auto weight = static_cast<std::uint32_t>(
          std::lround(embedded[v].weights[node] * DragFrameProblem::kWeightUnits));
      if (weight == 0) continue;
      packed[count++ * embedded.size() + v] = weight << 16U | embedded[v].nodes[node];
    }
  }
  return packed;
}

}  // namespace

VulkanDragFrame::VulkanDragFrame(std::shared_ptr<VulkanState> state,
                                 std::shared_ptr<const DragFrameProblem> problem)
    : state_(std::move(state)),
      problem_(std::move(problem)),
      vertex_count_(static_cast<std::uint32_t>(problem_->vertices.size())),
      rotations_(state_, *problem_->rings),
      places_{make_places(), make_places(), make_places()},
      inputs_{make_input(), make_input()},
      rest_(*state_->context, "rest positions", state_->real_bytes(3 * vertex_count_)),
      nodes_(*state_->context, "coarse vertices of vertices",
             kEmbeddingNodes * vertex_count_ * sizeof(std::uint32_t)),
      entries_(*state_->context, "prescribed entries", vertex_count_ * sizeof(Index)),
      stiffness_(*state_->context, "stiffness of constraints",
                 state_->real_bytes(problem_->stiffness.size())),
      unknowns_(*state_->context, "unknowns of vertices", vertex_count_ * sizeof(Index)),
      inverse_diagonal_(*state_->context, "inverse diagonal",
                        state_->real_bytes(problem_->inverse_diagonal.size())),
      vertices_(*state_->context, "vertices of the region", vertex_count_ * sizeof(Index)) {
  state_->upload_reals(rest_, numbers_of(problem_->rest));
  state_->transfer.upload(nodes_, packed_nodes(problem_->embedded));
  state_->transfer.upload(entries_, problem_->prescribed_entries);
  state_->upload_reals(stiffness_, problem_->stiffness);
  state_->transfer.upload(unknowns_, inverse_index(problem_->rings->unknown_rows, vertex_count_));
  state_->upload_reals(inverse_diagonal_, problem_->inverse_diagonal);
  state_->transfer.upload(vertices_, problem_->vertices);
}

gpu::Buffer VulkanDragFrame::make_places() const {
  return {*state_->context, "displacements of frames", VulkanState::place_bytes(vertex_count_)};
}

VulkanDragFrame::Input VulkanDragFrame::make_input() const {
  constexpr std::size_t kNumbersPerMotion = sizeof(RowsOfMotion) / sizeof(double);
  return {gpu::Buffer(*state_->context, "motions of coarse vertices",
                      state_->real_bytes(kNumbersPerMotion * problem_->node_count),
                      gpu::Memory::upload),
          gpu::Buffer(*state_->context, "prescribed displacements",
                      state_->real_bytes(3 * problem_->stiffness.size()), gpu::Memory::upload)};
}

void VulkanDragFrame::begin(std::span<const Eigen::Vector3d> displacement) {
  for (const gpu::Buffer& places : places_) state_->upload_places(places, displacement);
  now_ = 0;
}

void VulkanDragFrame::set_input(const DragFrameInput& input) {
  input_ = 1 - input_;
  write(inputs_[input_].motions, {input.motions.front().row[0], 12 * input.motions.size()});
  write(inputs_[input_].prescribed, numbers_of(input.prescribed));
}

// Writes to mapped memory.
void VulkanDragFrame::write(const gpu::Buffer& buffer, std::span<const double> numbers) const {
  if (state_->float64) {
    std::copy(numbers.begin(), numbers.end(), buffer.mapped_as<double>().begin());
  } else {
    std::transform(numbers.begin(), numbers.end(), buffer.mapped_as<float>().begin(),
                   [](double number) { return static_cast<float>(number); });
  }
  state_->context->count_upload(buffer.bytes());
}

void VulkanDragFrame::record(gpu::Recorder& recorder) {
  const VulkanPrograms& programs = *state_->programs;
  const Input& input = inputs_[input_];
  const auto unknown_count = static_cast<std::uint32_t>(problem_->inverse_diagonal.size());
  std::size_t last = now_;
  const auto next_of = [](std::size_t k) { return (k + 1) % 3; };

  now_ = next_of(last);
  recorder.dispatch(
      programs.prolongate, vertex_count_,
      {places_[last], places_[now_], rest_, nodes_, input.motions, entries_, input.prescribed},
      ProlongatePush{vertex_count_, static_cast<std::uint32_t>(problem_->exact_count)});
  for (const Sweep& sweep : problem_->sweeps) {
    rotations_.record(recorder, places_[now_]);
    const std::size_t next = next_of(now_);
    recorder.dispatch(programs.smooth, vertex_count_,
                      {places_[now_], places_[next], places_[last], rotations_.gradient(),
                       unknowns_, inverse_diagonal_, entries_, input.prescribed, stiffness_},
                      SmoothPush{vertex_count_, unknown_count, sweep.step, sweep.momentum});
    last = std::exchange(now_, next);
  }
}

void VulkanDragFrame::record_positions(gpu::Recorder& recorder, const Eigen::Vector3d& origin,
                                       const gpu::Buffer& positions) const {
  const Eigen::Vector3f offset = (problem_->origin - origin).cast<float>();
  recorder.dispatch(state_->programs->show_displacement, vertex_count_,
                    {places_[now_], rest_, vertices_, positions},
                    ShowPush{vertex_count_, {offset.x(), offset.y(), offset.z()}});
}

std::vector<Eigen::Vector3d> VulkanDragFrame::displacement() const {
  return state_->download_places(places_[now_], vertex_count_);
}

}  // namespace lapwing
