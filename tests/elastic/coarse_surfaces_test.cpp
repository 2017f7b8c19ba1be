#include "lapwing/elastic/coarse_surfaces.h"

#include <gtest/gtest.h>

#include "support/rippled_cylinder.h"

namespace lapwing {
namespace {

constexpr std::size_t kCoarseVertices = 1000;

// Surfaces of the rippled cylinder of 7,260 vertices, moved at one end.
class CoarseSurfacesOfACylinder : public ::testing::Test {
 protected:
  std::shared_ptr<const CoarseLevel> of(CoarseSurfaces& surfaces, const EditRegion& region) const {
    return surfaces.of(region, mesh_.topology(), rest_, kCoarseVertices);
  }
  static void expect_same(const std::shared_ptr<const CoarseLevel>& level,
                          const std::shared_ptr<const CoarseLevel>& expected) {
    ASSERT_NE(level, nullptr);
    ASSERT_NE(expected, nullptr);
    EXPECT_EQ(level->surface.kept, expected->surface.kept);
    EXPECT_EQ(level->surface.owners, expected->surface.owners);
    EXPECT_EQ(level->surface.topology.triangles, expected->surface.topology.triangles);
  }

  Mesh mesh_ = test::rippled_cylinder();
  std::shared_ptr<const Positions> rest_ = std::make_shared<const Positions>(mesh_.positions);
  EditRegion region_ = test::ends_of_cylinder(mesh_);
  EditRegion narrower_ = test::ends_of_cylinder(mesh_, 0.5, 5.5);
};

TEST_F(CoarseSurfacesOfACylinder, TheLastOneServesTheSameEditAgain) {
  CoarseSurfaces surfaces;
  const auto first = of(surfaces, region_);
  EXPECT_EQ(of(surfaces, region_), first);
  EXPECT_NE(of(surfaces, narrower_), first);
}

TEST_F(CoarseSurfacesOfACylinder, DependsOnNothingThatWasMadeBefore) {
  CoarseSurfaces fresh;
  CoarseSurfaces used;
  of(used, region_);
  expect_same(of(used, narrower_), of(fresh, narrower_));
}

TEST_F(CoarseSurfacesOfACylinder, IsNotThereWhereMostVerticesAreHeldOneByOne) {
  EditRegion held = region_;
  for (const Index v : held.roi) held.targets.push_back({.corners = {v, v, v}});
  CoarseSurfaces surfaces;
  EXPECT_EQ(of(surfaces, held), nullptr);
}

}  // namespace
}  // namespace lapwing
