#include "lapwing/mesh/morton_order.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <utility>

namespace lapwing {
namespace {

constexpr unsigned kBitsPerAxis = 10;

// Moves bit b of a number of kBitsPerAxis bits to bit 3 b.
std::uint32_t spread(std::uint32_t bits) {
  bits = (bits | bits << 16U) & 0x030000FFU;
  bits = (bits | bits << 8U) & 0x0300F00FU;
  bits = (bits | bits << 4U) & 0x030C30C3U;
  return (bits | bits << 2U) & 0x09249249U;
}

}  // namespace

std::vector<Index> morton_order(std::span<const Eigen::Vector3f> points) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  std::array<float, 3> low{kInfinity, kInfinity, kInfinity};
  float size = 0.0F;
  for (int axis = 0; axis < 3; ++axis) {
    float& lowest = low[static_cast<std::size_t>(axis)];
    float high = -kInfinity;
    // In this argument order, std::min and std::max ignore NaN.
    for (const Eigen::Vector3f& point : points) {
      lowest = std::min(lowest, point[axis]);
      high = std::max(high, point[axis]);
    }
    size = std::max(size, high - lowest);
  }
  constexpr float kLast = (1U << kBitsPerAxis) - 1U;
  const float scale = size > 0.0F ? kLast / size : 0.0F;
  std::vector<std::pair<std::uint32_t, Index>> places(points.size());
  for (Index p = 0; p < points.size(); ++p) {
    std::uint32_t place = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const float from_low = points[p][axis] - low[static_cast<std::size_t>(axis)];
      const float at = std::min(kLast, std::max(0.0F, from_low * scale));
      place |= spread(static_cast<std::uint32_t>(at)) << static_cast<unsigned>(axis);
    }
    places[p] = {place, p};
  }
  std::sort(places.begin(), places.end());
  std::vector<Index> numbers(points.size());
  std::transform(places.begin(), places.end(), numbers.begin(),
                 [](const auto& place) { return place.second; });
  return numbers;
}

}  // namespace lapwing
