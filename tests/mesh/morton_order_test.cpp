#include "lapwing/mesh/morton_order.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include <gtest/gtest.h>

namespace lapwing {
namespace {

using Eigen::Vector3f;

// The points are the corners of a cube, each twice. In the order, equal points are adjacent, x
// changes fastest and z slowest.
TEST(OrderInSpace, GoesAlongXThenYThenZ) {
  std::vector<Vector3f> points;
  for (int twice = 0; twice < 2; ++twice) {
    for (const float x : {5.0F, 6.0F}) {
      for (const float y : {5.0F, 6.0F}) {
        for (const float z : {5.0F, 6.0F}) points.emplace_back(x, y, z);
      }
    }
  }
  EXPECT_EQ(morton_order(points),
            (std::vector<Index>{0, 8, 4, 12, 2, 10, 6, 14, 1, 9, 5, 13, 3, 11, 7, 15}));
}

TEST(OrderInSpace, HasEveryPointOnceWhateverItIs) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  std::vector<Index> order = morton_order(std::vector<Vector3f>{
      {nan, nan, nan}, {1, 2, 3}, {infinity, 0, -infinity}, {1, 2, 3}, {0, 0, 0}});
  std::sort(order.begin(), order.end());
  EXPECT_EQ(order, (std::vector<Index>{0, 1, 2, 3, 4}));
  EXPECT_TRUE(morton_order({}).empty());
}

}  // namespace
}  // namespace lapwing
