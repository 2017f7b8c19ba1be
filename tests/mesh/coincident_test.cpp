#include "lapwing/mesh/coincident.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lapwing {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;

TEST(FirstAtSamePosition, NamesTheFirstOfEqualPositions) {
  const Positions positions{{1, 2, 3}, {0, 0, 0}, {1, 2, 3}, {3, 2, 1}, {1, 2, 3}};
  EXPECT_THAT(first_at_same_position(positions), ElementsAre(0, 1, 0, 3, 0));
}

TEST(FirstAtSamePosition, ComparesExactlyButForTheSignOfZero) {
  const double near_one = 1.0 + std::numeric_limits<double>::epsilon();
  const Positions positions{{0, 1, 0}, {-0.0, 1, 0}, {0, near_one, 0}};
  EXPECT_THAT(first_at_same_position(positions), ElementsAre(0, 0, 2));
}

TEST(FirstAtSamePosition, NonFinitePositionsEqualNothing) {
  const double inf = std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Positions positions{{inf, 0, 0}, {inf, 0, 0}, {nan, 0, 0}, {nan, 0, 0}};
  EXPECT_THAT(first_at_same_position(positions), ElementsAre(0, 1, 2, 3));
}

TEST(FirstAtSamePosition, ManyCopiesOfOnePointAreOneGroup) {
  EXPECT_THAT(first_at_same_position(Positions(10000, Eigen::Vector3d(1, 1, 1))), Each(0U));
}

}  // namespace
}  // namespace lapwing
