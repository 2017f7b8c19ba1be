#pragma once

#include <cstdint>
#include <span>

#include "tools/projection.h"

namespace lapwing::viewer {

/// A picture with 1 + the number of the triangle that shows at each pixel, 0 for the background
/// (IdPicture). Rows go from the top. `ids` must outlive this.
struct TrianglePicture {
  std::span<const std::uint32_t> ids;
  Index width = 0;
  Index height = 0;
};

/// Tells which vertices are visible in a picture. A vertex is visible if, at its pixel or a
/// neighbour, the drawn triangle is not in front of the vertex. A tolerance allows for the rounding
/// to pixels. The arguments of the constructor must outlive this object.
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
