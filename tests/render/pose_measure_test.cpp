#include "lapwing/render/pose_measure.h"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/deform/deform.h"
#include "support/bent_tube.h"

namespace lapwing::test {
namespace {

using ::testing::Each;
using ::testing::FloatNear;
using ::testing::Truly;

std::vector<float> measured(PoseMeasure measure, const Mesh& rest, const Positions& current) {
  return measure_pose(measure, rest.topology(), rest.positions, current);
}

Positions moved(const Mesh& mesh, const Eigen::Affine3d& motion) {
  Positions positions = mesh.positions;
  for (auto& p : positions) p = motion * p;
  return positions;
}

TEST(PoseMeasure, RestPoseHasNoNumbers) {
  const Mesh tube = bumpy_tube();
  for (const PoseMeasure measure : all_pose_measures()) {
    EXPECT_THAT(measured(measure, tube, tube.positions),
                Each(Truly([](float x) { return std::isnan(x); })));
  }
}

TEST(PoseMeasure, OnlyAVertexThatMovedAndItsRingHaveNumbers) {
  const Mesh sheet = grid(6, 6);
  Positions current = sheet.positions;
  const Index center = 3 * 7 + 3;
  current[center].z() += 0.5;
  const auto values = measured(PoseMeasure::displacement, sheet, current);
  const Topology& topology = sheet.topology();
  const auto ring = topology.rings[center];
  const auto numbers =
      std::count_if(values.begin(), values.end(), [](float value) { return !std::isnan(value); });
  EXPECT_EQ(numbers, static_cast<std::ptrdiff_t>(ring.size()) + 1);
  EXPECT_FLOAT_EQ(values[center], 0.5F);
  EXPECT_EQ(values[ring[0]], 0.0F);
}

TEST(PoseMeasure, AStiffBeltHasNoNumbers) {
  const Mesh tube = bumpy_tube();
  const EditRegion ends = foot_and_head(tube);
  const Deformed deformed = deform(tube, moved_head(ends, MatrixMove{bend().affine()}));
  ASSERT_NE(deformed.mesh.positions[ends.belt.front()], tube.positions[ends.belt.front()]);
  const auto values = measured(PoseMeasure::detail, tube, deformed.mesh.positions);
  for (const Index v : ends.belt) {
    const auto ring = tube.topology().rings[v];
    const bool touches_free =
        std::any_of(ring.begin(), ring.end(), [](Index w) { return w >= 24; });
    EXPECT_EQ(std::isnan(values[v]), !touches_free) << v;
  }
}

TEST(PoseMeasure, TurnOfTheWholeMeshIsRotationAlone) {
  const Mesh tube = bumpy_tube();
  const Positions turned =
      moved(tube, Eigen::Affine3d(Eigen::AngleAxisd(0.5, Eigen::Vector3d(1, 2, 3).normalized())));
  EXPECT_THAT(measured(PoseMeasure::rotation, tube, turned), Each(FloatNear(28.6479F, 1e-3F)));
  EXPECT_THAT(measured(PoseMeasure::detail, tube, turned), Each(FloatNear(0.0F, 1e-6F)));
  EXPECT_THAT(measured(PoseMeasure::stretch, tube, turned), Each(FloatNear(0.0F, 1e-6F)));
}

TEST(PoseMeasure, TwiceTheSizeStretchesEveryEdgeByItsLength) {
  const Mesh tube = bumpy_tube();
  const Positions grown = moved(tube, Eigen::Affine3d(Eigen::UniformScaling<double>(2.0)));
  const auto stretch = measured(PoseMeasure::stretch, tube, grown);
  EXPECT_THAT(stretch, Each(FloatNear(1.0F, 1e-6F)));
}

TEST(PoseMeasure, EveryMeasureHasANameAndALegendOfItsOwn) {
  std::vector<std::string_view> words;
  for (const PoseMeasure measure : all_pose_measures()) {
    words.push_back(name_of(measure));
    words.push_back(legend_title(measure));
  }
  std::sort(words.begin(), words.end());
  EXPECT_EQ(std::adjacent_find(words.begin(), words.end()), words.end());
  EXPECT_FALSE(words.front().empty());
}

}  // namespace
}  // namespace lapwing::test
