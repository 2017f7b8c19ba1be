#include "lapwing/region/falloff.h"

#include <array>
#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/region/edit_region.h"
#include "lapwing/region/geodesic.h"
#include "lapwing/region/transition.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// A sheet of 20 x 20 squares of edge 1/20, its lowest two rows held.
class AGradedSheet : public ::testing::Test {
 protected:
  AGradedSheet() {
    for (Index v = 0; v < 2 * kColumns; ++v) belt_.push_back(v);
  }
  EditRegion region() const {
    return resolve_edit_region(roi_, RegionSpec{ListedVertices{belt_}, "belt"}, handles_, mesh_,
                               LoosePolicy::carry, targets_);
  }
  std::string error() const {
    return error_message<InputError>([&] { region(); });
  }
  static Index at(Index column, Index row) { return row * kColumns + column; }
  // 0 where no handle reaches.
  std::vector<double> weights() const {
    std::vector<double> weights(mesh_.vertex_count(), 0.0);
    for (const FalloffVertex& graded : region().graded) weights[graded.vertex] = graded.weight;
    return weights;
  }
  static HandleSpec handle(VertexSet vertices, Falloff falloff = {}) {
    return {{ListedVertices{std::move(vertices)}, "handle"}, std::move(falloff)};
  }
  static Falloff falloff(double width, Transition::Profile profile = Transition::Profile::linear) {
    return {.transition = Transition{width, profile}};
  }
  std::vector<double> field(double value) const {
    return std::vector<double>(mesh_.vertex_count(), value);
  }

  static constexpr Index kColumns = 21;
  Mesh mesh_ = grid(kColumns - 1, kColumns - 1);
  RegionSpec roi_ = {AllVertices{}, "roi"};
  VertexSet belt_;
  std::vector<HandleSpec> handles_;
  TargetSpec targets_;
};

TEST_F(AGradedSheet, FallsOffWithTheDistanceFromTheHandle) {
  handles_ = {handle({at(10, 10)}, falloff(0.2))};
  const std::vector<double> w = weights();
  EXPECT_NEAR(w[at(11, 10)], 0.75, 1e-12);
  EXPECT_NEAR(w[at(12, 10)], 0.5, 1e-12);
  EXPECT_NEAR(w[at(10, 13)], 0.25, 1e-12);
  EXPECT_LT(w[at(14, 10)], 1e-12);
  EXPECT_EQ(w[at(10, 10)], 0.0) << "the handle's own";
  handles_[0].falloff = falloff(0.2, Transition::Profile::smooth);
  EXPECT_NEAR(weights()[at(11, 10)], 1.0 - 0.0625 * 2.5, 1e-12);
  EXPECT_NEAR(weights()[at(12, 10)], 0.5, 1e-12);
}

TEST_F(AGradedSheet, IsFirmWithoutAWidth) {
  handles_ = {handle({at(10, 10)}, falloff(1e-9))};
  EXPECT_THAT(region().graded, IsEmpty());
}

TEST_F(AGradedSheet, FallsOffOnlyInsideTheRoi) {
  VertexSet left;
  for (Index r = 0; r < kColumns; ++r) {
    for (Index c = 0; c <= 11; ++c) left.push_back(at(c, r));
  }
  roi_ = {ListedVertices{left}, "roi"};
  belt_ = {at(0, 0), at(1, 0)};
  handles_ = {handle({at(10, 10)}, falloff(0.2))};
  EXPECT_GT(weights()[at(11, 10)], 0.0);
  EXPECT_EQ(weights()[at(12, 10)], 0.0);
}

// Nor does it go on behind them: distances are measured around.
TEST_F(AGradedSheet, StopsAtTheBelt) {
  for (Index r = 2; r < kColumns; ++r) belt_.push_back(at(12, r));
  handles_ = {handle({at(10, 10)}, falloff(0.4))};
  const std::vector<double> w = weights();
  EXPECT_GT(w[at(11, 10)], 0.0);
  for (Index r = 0; r < kColumns; ++r) {
    for (Index c = 12; c < kColumns; ++c) EXPECT_EQ(w[at(c, r)], 0.0) << c << " " << r;
  }
}

TEST_F(AGradedSheet, StopsAtAnotherHandle) {
  VertexSet wall;
  for (Index r = 2; r < kColumns; ++r) wall.push_back(at(12, r));
  handles_ = {handle({at(10, 10)}, falloff(0.4)), handle(wall)};
  const std::vector<double> w = weights();
  EXPECT_GT(w[at(11, 10)], 0.0);
  EXPECT_EQ(w[at(12, 10)], 0.0);
  EXPECT_EQ(w[at(13, 10)], 0.0);
}

TEST_F(AGradedSheet, LeavesOutHardTargetsAndNoSoftOnes) {
  handles_ = {handle({at(10, 10)}, falloff(0.2))};
  targets_.rows = {{at(11, 10), {0, 0, 1}}};
  EXPECT_GT(weights()[at(11, 10)], 0.0);
  targets_.hard = true;
  EXPECT_EQ(weights()[at(11, 10)], 0.0);
}

TEST_F(AGradedSheet, GoesWithTheHandleThatWeighsMoreAndInTheMiddleWithNone) {
  handles_ = {handle({at(6, 10)}, falloff(0.4)), handle({at(12, 10)}, falloff(0.4))};
  std::vector<std::size_t> handle(mesh_.vertex_count(), 9);
  for (const FalloffVertex& g : region().graded) handle[g.vertex] = g.handle;
  EXPECT_EQ(handle[at(8, 10)], 0U);
  EXPECT_EQ(handle[at(9, 10)], 9U);
  EXPECT_EQ(handle[at(10, 10)], 1U);
  handles_[1].falloff = falloff(0.3);
  handle.assign(handle.size(), 9);
  for (const FalloffVertex& g : region().graded) handle[g.vertex] = g.handle;
  EXPECT_EQ(handle[at(9, 10)], 0U);
}

TEST_F(AGradedSheet, IsPaintedInsideItsRegion) {
  Falloff painted{.field = field(0.0)};
  painted.field[at(10, 10)] = painted.field[at(3, 3)] = 1.0;
  painted.field[at(11, 10)] = 0.25;
  handles_ = {handle({at(10, 10), at(11, 10), at(12, 10)}, painted)};
  EXPECT_THAT(region().handles[0], ElementsAre(at(10, 10)));
  EXPECT_THAT(region().graded, ElementsAre(FalloffVertex{at(11, 10), 0, 0.25}));
}

TEST_F(AGradedSheet, ThatCannotBeIsAnErrorWithItsPlace) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  handles_ = {handle({at(10, 10), at(11, 10)}, {.field = {1.0, 0.5}})};
  EXPECT_EQ(error(), "handle: expected a weight for each of the mesh's 441 vertices, got 2");
  for (const double wrong : {nan, 1.5, -0.5}) {
    handles_[0].falloff.field = field(1.0);
    handles_[0].falloff.field[7] = wrong;
    EXPECT_THAT(error(), HasSubstr("handle: the weight of vertex 7 must be from 0 to 1, not "));
  }
  handles_[0].falloff.field = field(0.5);
  EXPECT_EQ(error(),
            "handle: no vertex of the handle has weight 1; the largest weight is 0.5. Divide the "
            "field by it");
  handles_[0].falloff.field = field(0.0);
  EXPECT_EQ(error(), "handle: all vertices of the handle have weight 0. Paint some with weight 1");
  handles_[0].falloff.field = field(1.0);
  handles_[0].falloff.transition = Transition{0.1};
  EXPECT_EQ(error(),
            "handle: the handle has both painted weights and a falloff. Remove one of the two");
  for (const double wrong : {0.0, -1.0, nan, std::numeric_limits<double>::infinity()}) {
    handles_[0].falloff = {.weight = wrong};
    EXPECT_THAT(error(),
                HasSubstr("handle: expected a weight from 0.000001 to 1000000000000, got "))
        << wrong;
  }
  for (const double wrong : {-1.0, nan, std::numeric_limits<double>::infinity()}) {
    handles_[0].falloff = falloff(wrong);
    EXPECT_THAT(error(), HasSubstr("handle: expected a falloff width of 0 or more, got ")) << wrong;
  }
}

TEST(Transition, GoesFromNothingToAllOverItsWidth) {
  for (const auto profile : {Transition::Profile::smooth, Transition::Profile::linear}) {
    const Transition transition{2.0, profile};
    EXPECT_EQ(fade(transition, 0.0), 0.0);
    EXPECT_EQ(fade(transition, 1.0), 0.5);
    EXPECT_EQ(fade(transition, 2.0), 1.0);
    EXPECT_EQ(fade(transition, kNoLimit), 1.0);
    for (double x = 0.0; x < 2.0; x += 0.1) {
      EXPECT_LT(fade(transition, x), fade(transition, x + 0.1));
    }
  }
}

TEST(Transition, SmoothHasNoKinkAndLinearIsStraight) {
  const Transition smooth{1.0, Transition::Profile::smooth};
  EXPECT_LT(fade(smooth, 0.01) / 0.01, 0.04);
  EXPECT_LT((1.0 - fade(smooth, 0.99)) / 0.01, 0.04);
  EXPECT_DOUBLE_EQ(fade({1.0, Transition::Profile::linear}, 0.3), 0.3);
}

TEST(Transition, WithoutAWidthIsAllThereEverywhere) {
  EXPECT_EQ(fade({}, 0.0), 1.0);
}

}  // namespace
}  // namespace lapwing
