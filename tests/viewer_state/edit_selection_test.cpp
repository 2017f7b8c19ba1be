#include "state/edit_selection.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/mesh/shapes.h"
#include "lapwing/mesh/topology.h"

namespace lapwing::viewer {
namespace {

using ::testing::ElementsAre;

class Selecting : public ::testing::Test {
 protected:
  VertexSet resolved(const ChosenRegion& region) const {
    return resolve(spec_of(region, "region"), mesh_);
  }
  ChosenRegion disk(double radius) const {
    return choose({GeodesicDisk{Index{40}, radius}}, mesh_);
  }

  Mesh mesh_ = grid(8, 8);
  Topology topology_ = mesh_.topology();
};

TEST_F(Selecting, DiskKeepsItsFormWhenItIsPainted) {
  const ChosenRegion before = disk(0.3);
  const VertexSet painted = subtract(unite(before.vertices, {0, 1}), {40});
  const ChosenRegion after = repainted(before, painted);
  EXPECT_EQ(after.vertices, painted);
  EXPECT_THAT(after.added, ElementsAre(0, 1));
  EXPECT_THAT(after.removed, ElementsAre(40));
  EXPECT_EQ(resolved(after), painted);
}

TEST_F(Selecting, StrokesDoNotPileUp) {
  ChosenRegion region = disk(0.3);
  const ChosenRegion before = region;
  for (Index v = 0; v < 20; ++v) region = repainted(region, unite(region.vertices, {v}));
  for (Index v = 0; v < 20; ++v) {
    region = repainted(region, subtract(region.vertices, {v}));
    EXPECT_EQ(resolved(region), region.vertices);
  }
  region = repainted(region, before.vertices);
  EXPECT_EQ(spec_of(region, "region"), before.made);
}

TEST_F(Selecting, ListsAreWrittenAsTheyAre) {
  EXPECT_EQ(spec_of(repainted(disk(0.3), {}), "region"), RegionSpec{ListedVertices{}});
  EXPECT_EQ(spec_of(disk(0.0), "region"), (RegionSpec{ListedVertices{{40}}})) << "without radius";
  ChosenRegion region = choose({ListedVertices{{5, 3}}}, mesh_);
  region = repainted(region, unite(region.vertices, {4}));
  EXPECT_EQ(spec_of(region, "region"), (RegionSpec{ListedVertices{{3, 4, 5}}}));
}

TEST_F(Selecting, DiskThatStillHoldsTheSameVerticesIsCarriedOver) {
  const ChosenRegion region = disk(0.3);
  for (auto& p : mesh_.positions) p.z() += 1.0;
  EXPECT_EQ(carried_over(region, mesh_), region);
}

TEST_F(Selecting, DiskThatWouldHoldOthersBecomesAList) {
  const ChosenRegion region = disk(0.3);
  for (auto& p : mesh_.positions) p *= 2.0;
  const ChosenRegion carried = carried_over(region, mesh_);
  EXPECT_EQ(carried.vertices, region.vertices);
  EXPECT_EQ(resolved(carried), region.vertices);
}

TEST_F(Selecting, BeltLeavesTheHandlesOut) {
  EditSelection selection;
  selection.roi = choose({AllVertices{}}, mesh_);
  selection.handles = {choose({ListedVertices{{0, 1, 2}}}, mesh_)};
  selection.belt_fraction = 0.0;
  renew_belt(selection, mesh_);
  EXPECT_EQ(selection.belt.vertices.size(), 32U - 3U) << "the border of 9 x 9 vertices";
  EXPECT_TRUE(intersect(selection.belt.vertices, {0, 1, 2}).empty());
}

TEST_F(Selecting, WiderBeltHoldsTheNarrowOne) {
  EditSelection selection;
  selection.roi = choose({AllVertices{}}, mesh_);
  VertexSet narrow;
  for (const double fraction : {0.1, 0.3, 0.6, 1.0}) {
    selection.belt_fraction = fraction;
    renew_belt(selection, mesh_);
    EXPECT_TRUE(subtract(narrow, selection.belt.vertices).empty());
    narrow = selection.belt.vertices;
  }
  EXPECT_EQ(narrow, selection.roi.vertices);
}

}  // namespace
}  // namespace lapwing::viewer
