#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <type_traits>

#include "lapwing/gpu/pipeline_layout.h"

namespace lapwing {

/// Formats of the images that pipelines draw into, in a window or offscreen.
struct TargetFormat {
  /// Format of the image; it encodes linear light as sRGB.
  VkFormat color = VK_FORMAT_R8G8B8A8_SRGB;
  VkFormat depth = VK_FORMAT_D32_SFLOAT;
  VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
  /// If true, shaders encode colours once per pixel (shaders/target.glsl) and draw through a view
  /// that does not encode. For software devices, which otherwise encode every sample.
  bool shaders_encode = false;

  /// Returns the colour format that pipelines draw into.
  VkFormat drawn_color() const;
};

/// Returns the UNORM format that corresponds to `srgb`, or VK_FORMAT_UNDEFINED for formats that the
/// viewer's windows do not use.
VkFormat without_encoding(VkFormat srgb);

struct GraphicsPipelineInfo {
  std::string name;  ///< appears in error messages
  std::span<const std::uint32_t> vertex_spirv;
  std::span<const std::uint32_t> fragment_spirv;
  std::uint32_t storage_buffers = 0;  ///< bindings 0, 1, ... of both stages, which only read them
  std::uint32_t push_constant_bytes = 0;
  std::span<const std::uint32_t> constants;  ///< specialization constants 0, 1, ... of both stages
  bool depth = false;  ///< tests and writes depth; the greater depth is the nearer one
  bool blend = false;  ///< draws over the image with the fragment's opacity
};

/// The sides of triangles to draw. A triangle shows its front if its corners appear
/// counterclockwise.
enum class Sides { both, front, back };

/// A range of entries in a buffer of vertex indices (uint).
struct IndexRange {
  const gpu::Buffer* buffer;
  std::uint32_t first;
  std::uint32_t count;
};

/// Sets the scissor rectangle, outside which nothing is drawn.
void set_scissor(const gpu::Context& context, VkCommandBuffer commands, const VkRect2D& area);

/// Sets the viewport and the scissor rectangle, dynamic states of every GraphicsPipeline, to
/// `area`.
void set_viewport(const gpu::Context& context, VkCommandBuffer commands, const VkRect2D& area);

/// Draws triangles without vertex buffers. The shaders read vertex data from
/// storage buffers. The context must outlive the pipeline.
class GraphicsPipeline {
 public:
  /// If the device cannot draw or rejects the pipeline, throws GpuError, which names the pipeline.
  GraphicsPipeline(const gpu::Context& context, const TargetFormat& target,
                   const GraphicsPipelineInfo& info);
  GraphicsPipeline(const GraphicsPipeline&) = delete;
  GraphicsPipeline& operator=(const GraphicsPipeline&) = delete;

  /// Records a draw of `vertices` vertices from index `first` on, in a rendering scope. `buffers`
  /// are in the order of their bindings.
  template <typename Push>
  void draw(VkCommandBuffer commands, std::initializer_list<gpu::BufferRange> buffers,
            const Push& push, std::uint32_t vertices, std::uint32_t first = 0,
            Sides sides = Sides::both) const {
    bind(commands, buffers, push, sides);
    draw_vertices(commands, vertices, first);
  }
  /// Records a draw of the vertices that `indices` lists.
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

/// If the context's queue has no graphics support, throws GpuError, which tells the user what to
/// do.
void require_graphics(const gpu::Context& context);

}  // namespace lapwing
