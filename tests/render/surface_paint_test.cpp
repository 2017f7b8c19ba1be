#include "lapwing/render/surface_paint.h"

#include <array>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/mesh/shapes.h"
#include "render/picture.h"
#include "support/error_message.h"
#include "support/gpu.h"

namespace lapwing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(RangeWithoutOutliers, EndsAtTheLargestNumberUnlessAFewAreFarAbove) {
  std::vector<float> numbers(1000);
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<float>(i % 100);
  EXPECT_EQ(range_without_outliers(numbers).high, 99.0F);
  numbers[7] = 1e6F;
  EXPECT_EQ(range_without_outliers(numbers).high, 99.0F);
  EXPECT_EQ(range_without_outliers(numbers).low, 0.0F);
}

TEST(RangeWithoutOutliers, IsNotEmptyWhereFewNumbersAreNotZero) {
  std::vector<float> numbers(1000, 0.0F);
  numbers[7] = 5.0F;
  EXPECT_EQ(range_without_outliers(numbers).high, 5.0F);
}

TEST(RangeWithoutOutliers, KnowsFiniteNumbersOnly) {
  EXPECT_EQ(range_without_outliers(std::array{NAN, 2.0F, INFINITY}).high, 2.0F);
  EXPECT_EQ(range_without_outliers(std::array{NAN}).high, 0.0F);
}

TEST(SurfacePaint, RangeIsThatOfTheFiniteNumbers) {
  LAPWING_NEEDS_GPU();
  test::Subject subject(grid(1, 1));
  subject.paint.set_scalars(std::array{NAN, -2.0F, INFINITY, 3.0F});
  EXPECT_EQ(subject.paint.scalar_range().low, -2.0F);
  EXPECT_EQ(subject.paint.scalar_range().high, 3.0F);
  subject.paint.set_scalars(std::array{NAN, NAN, NAN, NAN});
  EXPECT_EQ(subject.paint.scalar_range().high, 0.0F);
}

TEST(SurfacePaint, WrongNumberOfValuesIsRefusedWithBothNumbers) {
  LAPWING_NEEDS_GPU();
  test::Subject subject(grid(1, 1));
  EXPECT_THAT(error_message<InputError>([&] {
                subject.paint.set_scalars(std::array{1.0F, 2.0F, 3.0F});
              }),
              AllOf(HasSubstr("3 vertex scalars"), HasSubstr("4")));
  EXPECT_THROW(subject.paint.set_classes(std::array{VertexClass::roi}), InputError);
}

}  // namespace
}  // namespace lapwing
