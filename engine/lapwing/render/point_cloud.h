#pragma once

#include <memory>
#include <span>

#include "lapwing/gpu/buffer.h"
#include "lapwing/gpu/transfer.h"
#include "lapwing/mesh/mesh.h"
#include "lapwing/render/revision.h"

namespace lapwing {

/// Points in device memory for drawing, in float32, 16 bytes each. The device must have finished
/// the last draw before they are moved.
class PointCloud {
 public:
  PointCloud(std::shared_ptr<gpu::Context> context, std::span<const Eigen::Vector3d> positions);

  /// Moves the points to `positions`, which has one entry per point, in one upload.
  void place(std::span<const Eigen::Vector3d> positions);

  std::size_t size() const { return buffer_.bytes() / (4 * sizeof(float)); }
  /// Returns the offset that is subtracted from the positions, as in Surface.
  const Eigen::Vector3d& origin() const { return origin_; }
  /// One vec4 per point: the position relative to `origin()`, and 1.
  const gpu::Buffer& buffer() const { return buffer_; }
  /// Returns a number that changes whenever the points move.
  std::uint64_t revision() const { return revision_.number(); }

 private:
  std::shared_ptr<gpu::Context> context_;
  gpu::Transfer transfer_;
  Eigen::Vector3d origin_;
  gpu::Buffer buffer_;
  Revision revision_;
};

}  // namespace lapwing
