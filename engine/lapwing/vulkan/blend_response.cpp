#include "lapwing/vulkan/blend_response.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

#include "lapwing/base/errors.h"
#include "lapwing/base/parallel.h"
#include "lapwing/shaders/blend_response.h"

namespace lapwing {
namespace {

// The memory layout in shaders/blend_response.comp.
constexpr std::size_t kColumnsPerGroup = 4;
struct alignas(16) GroupHeader {
  std::uint32_t group_count;
};

std::size_t groups_of(std::size_t columns) {
  return (columns + kColumnsPerGroup - 1) / kColumnsPerGroup;
}

// Returns the size of the columns of one vertex in bytes.
std::size_t bytes_per_vertex(std::size_t columns) {
  return 3 * groups_of(columns) * sizeof(Vec4);
}

constexpr std::size_t kVerticesPerTask = 4096;

gpu::Buffer upload_list(gpu::Context& context, gpu::Transfer& transfer, std::string name,
                        std::span<const Index> list) {
  gpu::Buffer buffer(context, std::move(name), list.size_bytes());
  transfer.upload(buffer, list);
  return buffer;
}

}  // namespace

std::shared_ptr<BlendResponse> upload_response(const std::shared_ptr<gpu::Context>& context,
                                               const ResponseColumns& columns,
                                               const Topology& topology) {
  gpu::Transfer transfer(*context);
  return std::make_shared<BlendResponse>(context, transfer, columns, topology);
}

BlendResponse::BlendResponse(std::shared_ptr<gpu::Context> context, gpu::Transfer& transfer,
                             const ResponseColumns& columns, const Topology& topology,
                             std::size_t most_bytes)
    : context_(std::move(context)),
      columns_(columns.count),
      moving_(columns.moving.begin(), columns.moving.end()),
      groups_(*context_, "blend parameters",
              sizeof(GroupHeader) + groups_of(columns_) * sizeof(BlendGroup), gpu::Memory::upload),
      affected_(upload_list(*context_, transfer, "vertices with new normals",
                            with_ring_neighbours(moving_, topology.rings))) {
  add_ranges(most_bytes == 0 ? context_->limits().maxStorageBufferRange : most_bytes, transfer);
  if (columns.along_axes) {
    fill_columns_along_axes(transfer, columns.numbers);
  } else {
    fill_columns(transfer, columns.numbers);
  }
  set_parameters(std::vector<double>(columns_, 0.0));
}

gpu::Kernel BlendResponse::kernel(const gpu::Context& context) {
  return {context, "blend_response", shaders::blend_response(), sizeof(std::uint32_t)};
}

void BlendResponse::add_ranges(std::size_t most_bytes, gpu::Transfer& transfer) {
  const std::size_t bytes = bytes_per_vertex(columns_);
  const std::size_t most = std::max<std::size_t>(1, most_bytes / std::max(bytes, sizeof(Vec4)));
  for (std::size_t first = 0; first < moving_.size(); first += most) {
    const std::size_t count = std::min(most, moving_.size() - first);
    ranges_.push_back({first, count,
                       upload_list(*context_, transfer, "moving vertices",
                                   std::span<const Index>(moving_).subspan(first, count)),
                       gpu::Buffer(*context_, "rest positions", count * sizeof(Vec4)),
                       gpu::Buffer(*context_, "response columns", count * bytes)});
  }
}

// Calls pack(m, out, stride) for each moving vertex m, and transfers the result to the device.
// `pack` must write one Vec4 per group and axis, at distances of `stride`.
template <typename Pack>
void BlendResponse::fill(gpu::Transfer& transfer, const Pack& pack) {
  for (const Range& range : ranges_) {
    const gpu::Buffer& buffer = range.columns;
    const std::size_t size = buffer.bytes() / sizeof(Vec4);
    std::vector<Vec4> own(buffer.mapped().empty() ? size : 0);
    Vec4* const out = own.empty() ? buffer.mapped_as<Vec4>().data() : own.data();
    parallel_for(range.count, kVerticesPerTask, [&](std::size_t begin, std::size_t end) {
      for (std::size_t m = begin; m < end; ++m) pack(range.first + m, out + m, range.count);
    });
    if (own.empty()) {
      context_->count_upload(buffer.bytes());
    } else {
      transfer.upload(buffer, own);
    }
  }
}

void BlendResponse::fill_columns(gpu::Transfer& transfer, std::span<const double> numbers) {
  fill(transfer, [&](std::size_t vertex, Vec4* out, std::size_t stride) {
    for (std::size_t first = 0; first < columns_; first += kColumnsPerGroup) {
      for (std::size_t axis = 0; axis < 3; ++axis, out += stride) {
        *out = {};
        for (std::size_t k = first; k < std::min(columns_, first + kColumnsPerGroup); ++k) {
          (*out)[k - first] = static_cast<float>(numbers[3 * (k * moving_.size() + vertex) + axis]);
        }
      }
    }
  });
}

void BlendResponse::fill_columns_along_axes(gpu::Transfer& transfer,
                                            std::span<const double> numbers) {
  fill(transfer, [&](std::size_t vertex, Vec4* out, std::size_t stride) {
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

void BlendResponse::set_rest(gpu::Transfer& transfer, std::span<const Eigen::Vector3d> rest,
                             std::span<const Eigen::Vector3d> displacement,
                             const Eigen::Vector3d& origin) {
  for (const Range& range : ranges_) {
    std::vector<Vec4> rests(range.count);
    for (std::size_t m = 0; m < range.count; ++m) {
      const Index v = moving_[range.first + m];
      rests[m] = place_of(displacement.empty() ? rest[v] : rest[v] + displacement[v], origin);
    }
    transfer.upload(range.rests, rests);
  }
}

void BlendResponse::record(gpu::Recorder& recorder, const gpu::Kernel& kernel,
                           const gpu::Buffer& positions) const {
  for (const Range& range : ranges_) {
    recorder.dispatch(kernel, range.count,
                      {groups_, range.moving, range.rests, range.columns, positions},
                      static_cast<std::uint32_t>(range.count));
  }
}

void BlendResponse::run_on_host(std::span<Vec4> positions) const {
  const std::byte* const memory = groups_.mapped().data();
  const std::span<const BlendGroup> groups(
      reinterpret_cast<const BlendGroup*>(memory + sizeof(GroupHeader)),
      reinterpret_cast<const GroupHeader*>(memory)->group_count);
  for (const Range& range : ranges_) {
    blend_on_host({range.moving.mapped_as<Index>(), range.rests.mapped_as<Vec4>(),
                   range.columns.mapped_as<Vec4>()},
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
  context_->count_upload(sizeof(GroupHeader) + count * sizeof(BlendGroup));
}

}  // namespace lapwing
