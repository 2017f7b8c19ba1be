#include "lapwing/render/draw_order.h"

#include <algorithm>
#include <vector>

#include "lapwing/mesh/morton_order.h"

namespace lapwing {
namespace {

// Returns an order of the triangles in which triangles with close centroids are close.
std::vector<Index> order_in_space(std::span<const Vec4> positions,
                                  std::span<const Triangle> triangles) {
  std::vector<Eigen::Vector3f> middles;
  middles.reserve(triangles.size());
  for (const Triangle& t : triangles) {
    const auto middle = [&](std::size_t axis) {
      return (positions[t[0]][axis] + positions[t[1]][axis] + positions[t[2]][axis]) / 3.0F;
    };
    middles.emplace_back(middle(0), middle(1), middle(2));
  }
  return morton_order(middles);
}

}  // namespace

DrawOrder::DrawOrder(const gpu::Context& context, std::span<const Vec4> positions,
                     std::span<const Triangle> triangles, std::span<const Index> normal_of_corner)
    : triangle_count_(triangles.size()),
      indices_(context, "drawn corners", triangles.size() * sizeof(Triangle)) {
  const std::span<Triangle> drawn = indices_.mapped_as<Triangle>();
  std::vector<Triangle> sharp;
  for (const Index number : order_in_space(positions, triangles)) {
    const Triangle& triangle = triangles[number];
    const Index first = 3 * number;
    if (normal_of_corner.empty() ||
        std::ranges::equal(triangle, normal_of_corner.subspan(first, 3))) {
      drawn[smooth_count_++] = triangle;
    } else {
      sharp.push_back({first, first + 1, first + 2});
    }
  }
  std::ranges::copy(sharp, drawn.begin() + static_cast<std::ptrdiff_t>(smooth_count_));
}

}  // namespace lapwing
