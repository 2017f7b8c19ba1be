#include "lapwing/gpu/transfer.h"

#include <algorithm>
#include <cstring>

#include "lapwing/base/errors.h"
#include "lapwing/gpu/context.h"
#include "lapwing/gpu/recorder.h"

namespace lapwing::gpu {
namespace {

// Large enough that the 0.2 ms of a submission do not matter, and small enough to remain allocated.
constexpr VkDeviceSize kStagingBytes = VkDeviceSize{16} << 20U;

void check_range(const Buffer& buffer, VkDeviceSize offset, std::size_t bytes) {
  if (offset <= buffer.bytes() && bytes <= buffer.bytes() - offset) return;
  throw GpuError("a copy of " + std::to_string(bytes) + " bytes at offset " +
                 std::to_string(offset) + " exceeds the buffer \"" + buffer.name() + "\" of " +
                 std::to_string(buffer.bytes()) + " bytes");
}

}  // namespace

struct Transfer::Staging {
  explicit Staging(Context& context)
      : up(context, "upload staging", kStagingBytes, Memory::upload),
        down(context, "download staging", kStagingBytes, Memory::readback),
        commands(context, "transfer") {}

  Buffer up;
  Buffer down;
  CommandList commands;
};

Transfer::Transfer(Context& context) : context_(context) {}
Transfer::~Transfer() = default;

Transfer::Staging& Transfer::staging() {
  if (!staging_) staging_ = std::make_unique<Staging>(context_);
  return *staging_;
}

void Transfer::upload(const Buffer& buffer, std::span<const std::byte> data, VkDeviceSize offset) {
  check_range(buffer, offset, data.size());
  if (data.empty()) return;
  context_.count_upload(data.size());
  if (!buffer.mapped().empty()) {
    std::memcpy(buffer.mapped().data() + offset, data.data(), data.size());
    return;
  }
  Staging& s = staging();
  for (std::size_t at = 0; at < data.size(); at += kStagingBytes) {
    const std::size_t piece = std::min<std::size_t>(kStagingBytes, data.size() - at);
    std::memcpy(s.up.mapped().data(), data.data() + at, piece);
    Recorder recorder(s.commands);
    recorder.copy({s.up, 0, piece}, {buffer, offset + at, piece});
    recorder.finish();
    s.commands.run();
  }
}

void Transfer::download(const Buffer& buffer, std::span<std::byte> data, VkDeviceSize offset) {
  check_range(buffer, offset, data.size());
  if (data.empty()) return;
  context_.count_download(data.size());
  if (!buffer.mapped().empty()) {
    std::memcpy(data.data(), buffer.mapped().data() + offset, data.size());
    return;
  }
  Staging& s = staging();
  for (std::size_t at = 0; at < data.size(); at += kStagingBytes) {
    const std::size_t piece = std::min<std::size_t>(kStagingBytes, data.size() - at);
    Recorder recorder(s.commands);
    recorder.copy({buffer, offset + at, piece}, {s.down, 0, piece});
    recorder.finish();
    s.commands.run();
    std::memcpy(data.data() + at, s.down.mapped().data(), piece);
  }
}

}  // namespace lapwing::gpu
