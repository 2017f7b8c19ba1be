#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lapwing/gpu/buffer.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/vulkan/host_frame.h"

namespace lapwing {

/// What a software device draws a surface's triangles by: an index buffer in mapped memory. First
/// the smooth triangles, whose corners have the normals of their vertices, by vertex, so that what
/// a vertex takes is done once for most of the triangles around it; then the others, by corner.
/// Both in an order in which triangles that lie close to each other follow each other, as the
/// device remembers only the last few vertices. Not for use from several threads at once.
class DrawOrder {
 public:
  /// Of `triangles`, which have their corners in `positions` for a start. O(n log n). All triangles
  /// are drawn by corner before the first `split`.
  DrawOrder(const gpu::Context& context, std::span<const Vec4> positions,
            std::span<const Triangle> triangles);

  /// Finds out which triangles are smooth where vertices have these positions and unit normals.
  /// The device must be done with the indices. Linear, on all threads; allocates nothing; the same
  /// order for any number of threads.
  void split(std::span<const Vec4> positions, std::span<const Vec4> normals);

  std::size_t smooth_count() const { return smooth_count_; }
  std::size_t sharp_count() const { return triangles_.size() - smooth_count_; }
  /// uint: three vertices for each smooth triangle, then for each sharp one the three places of its
  /// corners among the corners of all triangles; last three times 0, of which nothing shows either
  /// way.
  const gpu::Buffer& index_buffer() const { return indices_; }

 private:
  void write(std::size_t begin, std::size_t end, std::size_t smooth_before);

  std::vector<Index> numbers_;          ///< of the triangles, in order
  std::vector<Triangle> triangles_;     ///< in order
  std::vector<char> is_smooth_;         ///< in order
  std::vector<std::size_t> smooth_in_;  ///< each run of kRun triangles
  std::size_t smooth_count_ = 0;
  gpu::Buffer indices_;
};

/// The numbers of the triangles by their middles (mesh/space_order.h).
std::vector<Index> order_in_space(std::span<const Vec4> positions,
                                  std::span<const Triangle> triangles);

}  // namespace lapwing
