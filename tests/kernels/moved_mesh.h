#pragma once

#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/render/surface.h"

namespace lapwing::test {

/// A mesh that moves by a response: in a Surface on `context` or, without one, by the CPU twins of
/// its kernels.
class MovedMesh {
 public:
  MovedMesh(std::shared_ptr<gpu::Context> context, const Positions& rest, const Topology& topology,
            const ResponseColumns& columns)
      : columns_(columns), rest_(rest), topology_(topology), positions_(rest) {
    if (context == nullptr) return;
    surface_.emplace(context, rest, topology, 180.0);  // one normal per vertex, like the twin
    blend_ = upload_response(context, columns, topology);
    surface_->begin(*blend_, rest);
  }

  void blend(std::span<const double> parameters) {
    if (surface_) return surface_->blend(blend_, parameters);
    blend_response(rest_, columns_, parameters, positions_);
  }
  Positions positions() { return surface_ ? surface_->positions() : positions_; }
  std::vector<Eigen::Vector3d> normals() {
    if (surface_) return surface_->normals();
    std::vector<Index> all(positions_.size());
    std::iota(all.begin(), all.end(), 0U);
    std::vector<Eigen::Vector3d> normals(positions_.size());
    vertex_normals(positions_, topology_.triangles, topology_.vertex_triangles, all, normals);
    return normals;
  }

 private:
  ResponseColumns columns_;
  const Positions& rest_;
  const Topology& topology_;
  Positions positions_;
  std::optional<Surface> surface_;
  std::shared_ptr<BlendResponse> blend_;
};

}  // namespace lapwing::test
