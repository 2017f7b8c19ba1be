#include "lapwing/mesh/point_tree.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace lapwing {
namespace {

constexpr std::size_t kPointsOfLeaf = 8;

}  // namespace

PointTree::PointTree(std::span<const Eigen::Vector2d> points)
    : points_(points),
      items_(points.size()),
      leaf_of_(points.size(), 0),
      is_there_(points.size(), 1) {
  std::iota(items_.begin(), items_.end(), std::size_t{0});
  build(0, items_.size(), 0);
}

// Splits at the median along the longer side of the box.
std::size_t PointTree::build(std::size_t begin, std::size_t end, std::size_t parent) {
  const std::size_t number = nodes_.size();
  Eigen::AlignedBox2d box;
  for (std::size_t k = begin; k < end; ++k) box.extend(points_[items_[k]]);
  nodes_.push_back({box, begin, end, end - begin, 0, parent});
  if (end - begin <= kPointsOfLeaf) {
    for (std::size_t k = begin; k < end; ++k) leaf_of_[items_[k]] = number;
    return number;
  }
  Eigen::Index axis = 0;
  box.sizes().maxCoeff(&axis);
  const std::size_t middle = begin + (end - begin) / 2;
  const auto at = [&](std::size_t k) { return items_.begin() + static_cast<std::ptrdiff_t>(k); };
  std::nth_element(at(begin), at(middle), at(end), [&](std::size_t a, std::size_t b) {
    return std::pair(points_[a][axis], a) < std::pair(points_[b][axis], b);
  });
  build(begin, middle, number);
  const std::size_t second = build(middle, end, number);
  nodes_[number].second = second;
  return number;
}

void PointTree::take_out(std::size_t point) {
  is_there_[point] = 0;
  for (std::size_t node = leaf_of_[point];; node = nodes_[node].parent) {
    --nodes_[node].count;
    if (node == 0) return;
  }
}

}  // namespace lapwing
