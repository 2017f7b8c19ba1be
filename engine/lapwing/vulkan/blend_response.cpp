#include "lapwing/vulkan/blend_response.h"

#include <algorithm>
#include <cstdint>
#include <string>

#include "lapwing/base/errors.h"
#include "lapwing/gpu/context.h"

namespace lapwing {
namespace {

// Layouts of shaders/blend_response.comp.
struct Term {
  std::uint32_t column;
  float parameter;
};
struct Rest {
  float x, y, z;
  std::uint32_t vertex;
};
constexpr std::size_t kTermsOffset = sizeof(std::uint32_t);

// As many vertices as one storage buffer can hold `columns` columns of.
std::size_t vertices_per_range(const VkPhysicalDeviceLimits& limits, std::size_t columns) {
  const std::size_t bytes_per_vertex = std::max(sizeof(Rest), 3 * sizeof(float) * columns);
  return std::max<std::size_t>(1, limits.maxStorageBufferRange / bytes_per_vertex);
}

}  // namespace

BlendResponse::BlendResponse(VulkanState& state, const SurfaceInput& input,
                             const Eigen::Vector3d& origin)
    : state_(state),
      columns_(input.columns),
      terms_(*state.context, "blend parameters", kTermsOffset + columns_ * sizeof(Term),
             gpu::Memory::upload) {
  const std::size_t most = vertices_per_range(state.context->limits(), columns_);
  for (std::size_t first = 0; first < input.moving.size(); first += most) {
    add_range(input, origin, first, std::min(most, input.moving.size() - first));
  }
  set_parameters(std::vector<double>(columns_, 0.0));
}

void BlendResponse::add_range(const SurfaceInput& input, const Eigen::Vector3d& origin,
                              std::size_t first, std::size_t count) {
  std::vector<Rest> rests(count);
  for (std::size_t m = 0; m < count; ++m) {
    const Index vertex = input.moving[first + m];
    const Eigen::Vector3f place = (input.rest[vertex] - origin).cast<float>();
    rests[m] = {place.x(), place.y(), place.z(), vertex};
  }
  std::vector<float> basis(3 * columns_ * count);
  for (std::size_t k = 0; k < columns_; ++k) {
    const double* column = input.basis.data() + 3 * (k * input.moving.size() + first);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      float* out = basis.data() + (3 * k + axis) * count;
      for (std::size_t m = 0; m < count; ++m) out[m] = static_cast<float>(column[3 * m + axis]);
    }
  }
  const gpu::Context& context = *state_.context;
  ranges_.push_back({count, gpu::Buffer(context, "rest positions", count * sizeof(Rest)),
                     gpu::Buffer(context, "response basis", basis.size() * sizeof(float))});
  state_.transfer.upload(ranges_.back().rests, std::span<const Rest>(rests));
  state_.transfer.upload(ranges_.back().basis, std::span<const float>(basis));
}

void BlendResponse::record(gpu::Recorder& recorder, const gpu::Buffer& positions) const {
  for (const Range& range : ranges_) {
    recorder.dispatch(state_.blend_response, range.count,
                      {terms_, range.rests, range.basis, positions},
                      static_cast<std::uint32_t>(range.count));
  }
}

void BlendResponse::set_parameters(std::span<const double> parameters) {
  if (parameters.size() != columns_) {
    throw InputError("a blend of " + std::to_string(columns_) + " basis columns was given " +
                     std::to_string(parameters.size()) + " parameters");
  }
  const std::span<std::byte> memory = terms_.mapped();
  auto* const terms = reinterpret_cast<Term*>(memory.data() + kTermsOffset);
  std::uint32_t count = 0;
  for (std::uint32_t k = 0; k < parameters.size(); ++k) {
    if (parameters[k] != 0.0) terms[count++] = {k, static_cast<float>(parameters[k])};
  }
  *reinterpret_cast<std::uint32_t*>(memory.data()) = count;
}

}  // namespace lapwing
