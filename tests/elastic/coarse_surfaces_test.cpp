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

TEST_F(CoarseSurfacesOfACylinder, OneThatWasBegunIsTheSame) {
  CoarseSurfaces at_once;
  CoarseSurfaces in_two_steps;
  in_two_steps.begin(region_, mesh_.topology(), rest_);
  in_two_steps.begin(narrower_, mesh_.topology(), rest_);  // comes too late
  expect_same(of(in_two_steps, region_), of(at_once, region_));
  // The next one begins with the merges of the first.
  expect_same(of(in_two_steps, narrower_), of(at_once, narrower_));
}

TEST_F(CoarseSurfacesOfACylinder, OneThatWasBegunForAnotherEditIsNotTaken) {
  CoarseSurfaces asked;
  CoarseSurfaces begun;
  begun.begin(region_, mesh_.topology(), rest_);
  expect_same(of(begun, narrower_), of(asked, narrower_));

  Positions stretched = mesh_.positions;
  for (Eigen::Vector3d& p : stretched) p.x() *= 4.0;
  CoarseSurfaces of_other_positions;
  of_other_positions.begin(region_, mesh_.topology(),
                           std::make_shared<const Positions>(std::move(stretched)));
  CoarseSurfaces at_once;
  expect_same(of(of_other_positions, region_), of(at_once, region_));
}

TEST_F(CoarseSurfacesOfACylinder, NothingBeginsAfterTheFirst) {
  CoarseSurfaces surfaces;
  const auto first = of(surfaces, region_);
  surfaces.begin(narrower_, mesh_.topology(), rest_);
  EXPECT_EQ(of(surfaces, region_), first);
}

}  // namespace
}  // namespace lapwing
