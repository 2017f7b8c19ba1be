#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "lapwing/gpu/buffer.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/vulkan/host_frame.h"

namespace lapwing {

/// The order in which a software device draws triangles, as an index buffer in mapped memory. A
/// triangle is smooth if each of its corners has the first normal of its vertex. Smooth triangles
/// come first and are indexed by vertex, so that neighbours can share runs of the vertex shader.
/// The other triangles are sharp and are indexed by corner. Triangles that are close in space
/// follow each other, because the device caches only a few vertices.
class DrawOrder {
 public:
  /// Orders `triangles` by their `positions` in O(n log n). `normal_of_corner` is
  /// SplitNormals::of_corner, or empty if no normal is split.
  DrawOrder(const gpu::Context& context, std::span<const Vec4> positions,
            std::span<const Triangle> triangles, std::span<const Index> normal_of_corner);

  std::size_t smooth_count() const { return smooth_count_; }
  std::size_t sharp_count() const { return triangle_count_ - smooth_count_; }
  /// Contains first the three vertices of each smooth triangle, then the three corner numbers
  /// 3 t + k of each sharp triangle t. All entries are uint.
  const gpu::Buffer& index_buffer() const { return indices_; }

 private:
  std::size_t triangle_count_;
  std::size_t smooth_count_ = 0;
  gpu::Buffer indices_;
};

}  // namespace lapwing
