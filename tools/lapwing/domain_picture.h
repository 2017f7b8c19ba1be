#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "lapwing/io/image.h"
#include "lapwing/parameterize/domain_map.h"

namespace lapwing::cli {

using PictureColor = std::array<std::uint8_t, 3>;  ///< red, green, blue in sRGB

/// One triangulation in the picture of a domain. Spans are of the caller.
struct DomainLayer {
  std::span<const Triangle> triangles;
  std::span<const Eigen::Vector2d> points;
  std::span<const Index> loop;  ///< the boundary, drawn bold
  std::span<const Index> pins;  ///< vertices with a dot
  std::span<const Index>
      flipped;  ///< triangles filled red, each with a spot that shows if it is tiny
  PictureColor color{30, 60, 120};
};

/// The layers, the first at the bottom, on white: a square of `size` x `size` pixels that holds the
/// domain with a margin. Lines are smoothed, and thinner where triangles are small.
Image draw_domain(Domain domain, std::span<const DomainLayer> layers, std::uint32_t size);

}  // namespace lapwing::cli
