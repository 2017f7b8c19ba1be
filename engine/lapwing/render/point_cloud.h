#pragma once

#include <memory>
#include <span>

#include "lapwing/gpu/buffer.h"
#include "lapwing/gpu/transfer.h"
#include "lapwing/mesh/mesh.h"
#include "lapwing/render/revision.h"

namespace lapwing {

/// Points in device memory, in float32, 16 bytes each, from which they are drawn. The device must
/// be done with what was drawn last whenever they are moved.
class PointCloud {
 public:
  PointCloud(std::shared_ptr<gpu::Context> context, std::span<const Eigen::Vector3d> positions);

  /// Puts as many points as there are where `positions` says: one upload.
  void place(std::span<const Eigen::Vector3d> positions);

  std::size_t size() const { return buffer_.bytes() / (4 * sizeof(float)); }
  /// What was subtracted from the positions, as in Surface.
  const Eigen::Vector3d& origin() const { return origin_; }
  /// One vec4 per point: the position relative to `origin()`, and 1.
  const gpu::Buffer& buffer() const { return buffer_; }
  /// Another number whenever they moved.
  std::uint64_t revision() const { return revision_.number(); }

 private:
  std::shared_ptr<gpu::Context> context_;
  gpu::Transfer transfer_;
  Eigen::Vector3d origin_;
  gpu::Buffer buffer_;
  Revision revision_;
};

}  // namespace lapwing
