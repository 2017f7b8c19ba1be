#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "lapwing/gpu/buffer.h"
#include "lapwing/gpu/owned.h"

namespace lapwing::gpu {

/// The layout of a pipeline with storage buffers and push constants. The buffers have the bindings
/// 0, 1, ... of one set, and are bound by push descriptors.
class PipelineLayout {
 public:
  /// `buffers` is the number of storage buffers, at most kMaxBuffers.
  PipelineLayout(const Context& context, VkShaderStageFlags stages, std::uint32_t buffers,
                 std::uint32_t push_constant_bytes);

  /// Vulkan guarantees at least 32 push descriptors.
  static constexpr std::size_t kMaxBuffers = 16;

  VkPipelineLayout handle() const { return layout_.get(); }

  /// Records commands that bind a pipeline of this layout and its buffers, and set its push
  /// constants.
  void bind(VkCommandBuffer commands, VkPipelineBindPoint point, VkPipeline pipeline,
            std::span<const BufferRange> buffers, std::span<const std::byte> push) const;

 private:
  const Context* context_;
  VkShaderStageFlags stages_;
  Owned<VkDescriptorSetLayout> set_;
  Owned<VkPipelineLayout> layout_;
};

/// Returns a shader module. It can be destroyed as soon as its pipeline exists.
Owned<VkShaderModule> shader_module(const Context& context, std::span<const std::uint32_t> spirv);

}  // namespace lapwing::gpu
