#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lapwing/gpu/buffer.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/vulkan/host_frame.h"

namespace lapwing {

/// The order in which a software device draws triangles: an index buffer in mapped memory. Smooth
/// triangles, whose corners have the normals of their vertices, come first and are drawn by vertex,
/// so that most triangles around a vertex share its work. The others are drawn by corner. Triangles
/// close in space follow each other, because the device remembers only the last few vertices. Not
/// thread-safe.
class DrawOrder {
 public:
  /// Orders `triangles` by their initial `positions`. O(n log n). All are drawn by corner before
  /// the first `split`.
  DrawOrder(const gpu::Context& context, std::span<const Vec4> positions,
            std::span<const Triangle> triangles);

  /// Finds the smooth triangles for these positions and unit normals. The device must have finished
  /// with the indices. Linear, on all threads, without allocations. The order does not depend on
  /// the number of threads.
  void split(std::span<const Vec4> positions, std::span<const Vec4> normals);

  std::size_t smooth_count() const { return smooth_count_; }
  std::size_t sharp_count() const { return triangles_.size() - smooth_count_; }
  /// Entries are uint: three vertices for each smooth triangle, then three corner numbers 3 t + k
  /// for each sharp triangle t. Three zeros follow, which draw nothing.
  const gpu::Buffer& index_buffer() const { return indices_; }

 private:
  void write(std::size_t begin, std::size_t end, std::size_t smooth_before);

  std::vector<Index> numbers_;          ///< triangle numbers in drawing order
  std::vector<Triangle> triangles_;     ///< in drawing order
  std::vector<char> is_smooth_;         ///< in drawing order
  std::vector<std::size_t> smooth_in_;  ///< per run of kRun triangles
  std::size_t smooth_count_ = 0;
  gpu::Buffer indices_;
};

/// Returns the triangle numbers in the order of their centroids in space (mesh/morton_order.h).
std::vector<Index> morton_order(std::span<const Vec4> positions,
                                std::span<const Triangle> triangles);

}  // namespace lapwing
