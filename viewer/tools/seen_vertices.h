#pragma once

#include <cstdint>
#include <span>

#include "tools/projection.h"

namespace lapwing::viewer {

/// An image that stores 1 + the index of the visible triangle at each pixel, or 0 for the
/// background (IdPicture). The first row is at the top. `ids` must outlive this object.
struct TrianglePicture {
  std::span<const std::uint32_t> ids;
  Index width = 0;
  Index height = 0;
};

/// Determines which vertices are visible in an image of triangle indices. A vertex is visible if
/// the triangle at its pixel, or at an adjacent pixel, is not in front of the vertex. The depth
/// comparison has a tolerance for the rounding to pixels. The arguments of the constructor must
/// outlive this object.
class SeenVertices {
 public:
  SeenVertices(const TrianglePicture& picture, const Topology& topology,
               std::span<const Eigen::Vector3d> positions, const Projection& projection)
      : picture_(picture), topology_(topology), positions_(positions), projection_(projection) {}

  bool operator()(Index vertex) const;

 private:
  bool hides(Index triangle, Index vertex, const Ray& sight, double tolerance) const;

  const TrianglePicture picture_;
  const Topology& topology_;
  const std::span<const Eigen::Vector3d> positions_;
  const Projection& projection_;
};

}  // namespace lapwing::viewer
