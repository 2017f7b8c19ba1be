#include "lapwing/vulkan/blend_response.h"

#include <algorithm>
#include <cstdint>
#include <string>

#include "lapwing/base/errors.h"
#include "lapwing/base/parallel.h"
#include "lapwing/gpu/context.h"

namespace lapwing {
namespace {

using Format = gpu::TexelBuffer::Format;

// Layouts of shaders/blend_response.comp.
constexpr std::size_t kColumnsPerGroup = 4;
struct alignas(16) GroupHeader {
  std::uint32_t group_count;
};

std::size_t groups_of(std::size_t columns) {
  return (columns + kColumnsPerGroup - 1) / kColumnsPerGroup;
}

constexpr std::size_t kVerticesPerTask = 4096;

}  // namespace

BlendResponse::BlendResponse(VulkanState& state, const SurfaceInput& input,
                             const Eigen::Vector3d& origin, std::size_t most_texels)
    : state_(state),
      columns_(input.columns),
      moving_(input.moving.begin(), input.moving.end()),
      origin_(origin),
      groups_(*state.context, "blend parameters",
              sizeof(GroupHeader) + groups_of(columns_) * sizeof(BlendGroup), gpu::Memory::upload) {
  if (most_texels == 0) most_texels = state.context->limits().maxTexelBufferElements;
  const std::size_t texels_per_vertex = std::max<std::size_t>(1, 3 * groups_of(columns_));
  const std::size_t most = std::max<std::size_t>(1, most_texels / texels_per_vertex);
  for (std::size_t first = 0; first < input.moving.size(); first += most) {
    add_range(first, std::min(most, input.moving.size() - first));
  }
  set_rest(input.rest);
  if (!input.basis.empty()) set_basis(input.basis);
  set_parameters(std::vector<double>(columns_, 0.0));
}

// Calls pack(vertex of moving, texels of that vertex, how far apart these are), per group and axis,
// and puts the texels where the device reads them.
template <typename Pack>
void BlendResponse::fill(const Pack& pack) {
  for (const Range& range : ranges_) {
    const std::size_t texels = 3 * groups_of(columns_) * range.count;
    const gpu::Buffer& buffer = range.basis.buffer();
    std::vector<Vec4> own(buffer.mapped().empty() ? texels : 0);
    Vec4* const out = own.empty() ? reinterpret_cast<Vec4*>(buffer.mapped().data()) : own.data();
    parallel_for(range.count, kVerticesPerTask, [&](std::size_t begin, std::size_t end) {
      for (std::size_t m = begin; m < end; ++m) pack(range.first + m, out + m, range.count);
    });
    if (own.empty()) {
      state_.context->count_upload(texels * sizeof(Vec4));
    } else {
      state_.transfer.upload(buffer, std::span<const Vec4>(own));
    }
  }
}

void BlendResponse::set_basis(std::span<const double> basis) {
  fill([&](std::size_t vertex, Vec4* out, std::size_t stride) {
    for (std::size_t first = 0; first < columns_; first += kColumnsPerGroup) {
      for (std::size_t axis = 0; axis < 3; ++axis, out += stride) {
        *out = {};
        for (std::size_t k = first; k < std::min(columns_, first + kColumnsPerGroup); ++k) {
          (*out)[k - first] = static_cast<float>(basis[3 * (k * moving_.size() + vertex) + axis]);
        }
      }
    }
  });
}

void BlendResponse::set_axis_basis(std::span<const double> numbers) {
  fill([&](std::size_t vertex, Vec4* out, std::size_t stride) {
    for (std::size_t group = 0; group < groups_of(columns_); ++group) {
      for (std::size_t axis = 0; axis < 3; ++axis, out += stride) {
        *out = {};
        if (axis != group % 3) continue;
        for (std::size_t k = 0; k < kColumnsPerGroup; ++k) {
          const std::size_t column = kColumnsPerGroup * (group / 3) + k;
          (*out)[k] = static_cast<float>(numbers[column * moving_.size() + vertex]);
        }
      }
    }
  });
}

void BlendResponse::add_range(std::size_t first, std::size_t count) {
  const gpu::Context& context = *state_.context;
  ranges_.push_back(
      {first, count, gpu::TexelBuffer(context, "moving vertices", Format::uint, count),
       gpu::TexelBuffer(context, "rest positions", Format::vec4, count),
       gpu::TexelBuffer(context, "response basis", Format::vec4, 3 * groups_of(columns_) * count)});
  state_.transfer.upload(ranges_.back().moving.buffer(),
                         std::span<const Index>(moving_).subspan(first, count));
}

void BlendResponse::set_rest(std::span<const Eigen::Vector3d> positions) {
  for (const Range& range : ranges_) {
    std::vector<Vec4> rests;
    rests.reserve(range.count);
    for (std::size_t m = range.first; m < range.first + range.count; ++m) {
      const Eigen::Vector3f place = (positions[moving_[m]] - origin_).cast<float>();
      rests.push_back({place.x(), place.y(), place.z(), 1.0F});
    }
    state_.transfer.upload(range.rests.buffer(), std::span<const Vec4>(rests));
  }
}

void BlendResponse::record(gpu::Recorder& recorder, const gpu::Buffer& positions) const {
  for (const Range& range : ranges_) {
    recorder.dispatch(state_.blend_response, range.count,
                      {groups_, range.moving, range.rests, range.basis, positions},
                      static_cast<std::uint32_t>(range.count));
  }
}

void BlendResponse::run_on_host(std::span<Vec4> positions) const {
  const std::byte* const memory = groups_.mapped().data();
  const std::span<const BlendGroup> groups(
      reinterpret_cast<const BlendGroup*>(memory + sizeof(GroupHeader)),
      reinterpret_cast<const GroupHeader*>(memory)->group_count);
  for (const Range& range : ranges_) {
    blend_on_host({range.moving.buffer().mapped_as<Index>(), range.rests.buffer().mapped_as<Vec4>(),
                   range.basis.buffer().mapped_as<Vec4>()},
                  groups, positions);
  }
}

void BlendResponse::set_parameters(std::span<const double> parameters) {
  if (parameters.size() != columns_) {
    throw InputError("a blend of " + std::to_string(columns_) + " basis columns was given " +
                     std::to_string(parameters.size()) + " parameters");
  }
  const std::span<std::byte> memory = groups_.mapped();
  auto* const groups = reinterpret_cast<BlendGroup*>(memory.data() + sizeof(GroupHeader));
  std::uint32_t count = 0;
  for (std::size_t k = 0; k < columns_; k += kColumnsPerGroup) {
    const auto group = parameters.subspan(k, std::min(kColumnsPerGroup, columns_ - k));
    if (std::all_of(group.begin(), group.end(), [](double p) { return p == 0.0; })) continue;
    BlendGroup& out = groups[count++];
    out = {{}, static_cast<std::uint32_t>(k / kColumnsPerGroup)};
    std::transform(group.begin(), group.end(), out.parameters.begin(),
                   [](double p) { return static_cast<float>(p); });
  }
  reinterpret_cast<GroupHeader*>(memory.data())->group_count = count;
  state_.context->count_upload(sizeof(GroupHeader) + count * sizeof(BlendGroup));
}

}  // namespace lapwing
