#include "lapwing/solve/block_cholesky/denormals.h"

#include <limits>

#include <gtest/gtest.h>

namespace lapwing::cholesky {
namespace {

// A product that compilers leave to the processor.
float product(float a, float b) {
  volatile float factor = a;
  return factor * b;
}

TEST(Denormals, AreZeroInFloatsForAsLongAsThatIsWanted) {
  const float least = std::numeric_limits<float>::min();
  EXPECT_GT(product(least, 0.25F), 0.0F);
  {
    [[maybe_unused]] const DenormalsFor<float> flushed;
    EXPECT_EQ(product(least, 0.25F), 0.0F);
    EXPECT_EQ(product(std::numeric_limits<float>::denorm_min(), 1e30F), 0.0F);
    EXPECT_EQ(product(least, 4.0F), 4.0F * least);
  }
  EXPECT_GT(product(least, 0.25F), 0.0F);
}

TEST(Denormals, AreKeptInDoubles) {
  [[maybe_unused]] const DenormalsFor<double> kept;
  volatile double factor = std::numeric_limits<double>::min();
  EXPECT_GT(factor * 0.25, 0.0);
}

}  // namespace
}  // namespace lapwing::cholesky
