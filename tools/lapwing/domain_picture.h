#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "lapwing/io/image.h"
#include "lapwing/parameterize/domain_map.h"

namespace lapwing::cli {

using PictureColor = std::array<std::uint8_t, 3>;  ///< red, green, blue in sRGB

/// A triangulation in the picture of a domain. The caller owns the spans.
struct DomainLayer {
  std::span<const Triangle> triangles;
  std::span<const Eigen::Vector2d> points;
  std::span<const Index> loop;     ///< the boundary, drawn bold
  std::span<const Index> pins;     ///< vertices with a dot
  std::span<const Index> flipped;  ///< triangles, filled red; a spot marks even a tiny one
  PictureColor color{30, 60, 120};
};

/// Draws the layers on white, the first at the bottom. The picture has `size` x `size` pixels and a
/// margin around the domain. Lines are antialiased, and thinner where triangles are small.
Image draw_domain(Domain domain, std::span<const DomainLayer> layers, std::uint32_t size);

}  // namespace lapwing::cli
