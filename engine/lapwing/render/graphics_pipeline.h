#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <type_traits>

#include "lapwing/gpu/pipeline_layout.h"

namespace lapwing {

/// Format of the images that pipelines draw into: a window's or an offscreen target's.
struct TargetFormat {
  VkFormat color = VK_FORMAT_R8G8B8A8_SRGB;  ///< format of the image; encodes linear light
  VkFormat depth = VK_FORMAT_D32_SFLOAT;
  VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
  /// If true, shaders encode colours themselves (shaders/target.glsl), once per pixel, and draw
  /// into the same bits without an encoding. For software devices, which otherwise encode every
  /// sample.
  bool shaders_encode = false;

  /// Returns the colour format that pipelines draw into.
  VkFormat drawn_color() const;
};

/// Returns the format of the same bits without an encoding, or VK_FORMAT_UNDEFINED for formats that
/// no window of the viewer has.
VkFormat without_encoding(VkFormat srgb);

struct GraphicsPipelineInfo {
  std::string name;  ///< appears in error messages
  std::span<const std::uint32_t> vertex_spirv;
  std::span<const std::uint32_t> fragment_spirv;
  std::uint32_t storage_buffers = 0;  ///< bindings 0, 1, ... of both stages, which only read them
  std::uint32_t push_constant_bytes = 0;
  std::span<const std::uint32_t> constants;  ///< specialization constants 0, 1, ... of both stages
  bool depth = false;  ///< test and write depth: nearer, that is greater, wins
  bool blend = false;  ///< blend by opacity over the image, and add to the image's opacity
};

/// Which sides of triangles are drawn; the front is the one seen counter-clockwise.
enum class Sides { both, front, back };

/// A range of vertex numbers in a buffer of uint.
struct IndexRange {
  const gpu::Buffer* buffer;
  std::uint32_t first;
  std::uint32_t count;
};

/// Sets the viewport and the scissor to `area`. Both are dynamic states of every GraphicsPipeline.
void set_viewport(const gpu::Context& context, VkCommandBuffer commands, const VkRect2D& area);

/// Draws triangles without vertex buffers. The shaders read vertex data from
/// storage buffers. The context must outlive the pipeline.
class GraphicsPipeline {
 public:
  /// Throws GpuError, naming the pipeline, if the device cannot draw or rejects the pipeline.
  GraphicsPipeline(const gpu::Context& context, const TargetFormat& target,
                   const GraphicsPipelineInfo& info);
  GraphicsPipeline(const GraphicsPipeline&) = delete;
  GraphicsPipeline& operator=(const GraphicsPipeline&) = delete;

  /// Records a draw of `vertices` vertices, starting with number `first`, in a rendering scope.
  /// `buffers` are in the order of their bindings.
  template <typename Push>
  void draw(VkCommandBuffer commands, std::initializer_list<gpu::BufferRange> buffers,
            const Push& push, std::uint32_t vertices, std::uint32_t first = 0,
            Sides sides = Sides::both) const {
    bind(commands, buffers, push, sides);
    draw_vertices(commands, vertices, first);
  }
  /// The same for the vertices that `indices` lists.
  template <typename Push>
  void draw(VkCommandBuffer commands, std::initializer_list<gpu::BufferRange> buffers,
            const Push& push, const IndexRange& indices, Sides sides = Sides::both) const {
    bind(commands, buffers, push, sides);
    draw_indices(commands, indices);
  }

 private:
  void create_pipeline(const TargetFormat& target, const GraphicsPipelineInfo& info);
  template <typename Push>
  void bind(VkCommandBuffer commands, std::initializer_list<gpu::BufferRange> buffers,
            const Push& push, Sides sides) const {
    static_assert(std::is_trivially_copyable_v<Push>);
    bind_bytes(commands, {buffers.begin(), buffers.size()}, std::as_bytes(std::span(&push, 1)),
               sides);
  }
  void bind_bytes(VkCommandBuffer commands, std::span<const gpu::BufferRange> buffers,
                  std::span<const std::byte> push, Sides sides) const;
  void draw_vertices(VkCommandBuffer commands, std::uint32_t vertices, std::uint32_t first) const;
  void draw_indices(VkCommandBuffer commands, const IndexRange& indices) const;

  const gpu::Context& context_;
  std::string name_;
  gpu::PipelineLayout layout_;
  gpu::Owned<VkPipeline> pipeline_;
};

/// Throws GpuError with the next step if the context's queue has no graphics.
void require_graphics(const gpu::Context& context);

}  // namespace lapwing
