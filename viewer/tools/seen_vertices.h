#pragma once

#include <cstdint>
#include <span>

#include "tools/projection.h"

namespace lapwing::viewer {

/// A picture of which triangle shows at each pixel, rows from the top: 1 + its number, or 0 (as
/// IdPicture draws it). The numbers must outlive this.
struct TrianglePicture {
  std::span<const std::uint32_t> ids;
  Index width = 0;
  Index height = 0;
};

/// Tells which vertices are seen in a picture: in the window, and at their pixel, or one beside it,
/// nothing shows that lies in front of them by more than rounding to pixels accounts for. What it
/// is made of must outlive it.
class SeenVertices {
 public:
  SeenVertices(const TrianglePicture& picture, const Topology& topology,
               std::span<const Eigen::Vector3d> positions, const Projection& projection)
      : picture_(picture), topology_(topology), positions_(positions), projection_(projection) {}

  bool operator()(Index vertex) const;

 private:
  bool hides(Index triangle, Index vertex, const SightLine& sight, double tolerance) const;

  const TrianglePicture picture_;
  const Topology& topology_;
  const std::span<const Eigen::Vector3d> positions_;
  const Projection& projection_;
};

}  // namespace lapwing::viewer
