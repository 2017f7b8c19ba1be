#include "lapwing/deform/coarse_proxy.h"

#include <numeric>

#include <gtest/gtest.h>

#include "lapwing/elastic/prepared_region.h"
#include "support/rippled_cylinder.h"

namespace lapwing {
namespace {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector3d;

// The rippled cylinder of 7,260 vertices, held and moved at its ends, and the same of 1,000.
class CoarseCylinder : public ::testing::Test {
 protected:
  CoarseEmbedding::Pose rest() const {
    return {std::vector<Vector3d>(surface().kept.size(), Vector3d::Zero()),
            std::vector<Matrix3d>(surface().kept.size(), Matrix3d::Identity())};
  }
  const CoarseSurface& surface() const { return coarse_->level->surface; }
  Vector3d place(std::size_t own, const CoarseEmbedding::Pose& pose) const {
    return mesh_.positions[surface().kept[own]] + pose.displacement[own];
  }

  Mesh mesh_ = test::rippled_cylinder();
  PreparedRegion prepared_{mesh_.topology()};
  EditSystem fine_{prepared_, mesh_.positions, test::ends_of_cylinder(mesh_), {}, {}};
  std::unique_ptr<CoarseRegion> coarse_ = coarse_region(fine_, 1000);
};

TEST_F(CoarseCylinder, HasTheVerticesAskedForAndTheirSets) {
  ASSERT_NE(coarse_, nullptr);
  const EditRegion& region = coarse_->edit->region;
  EXPECT_EQ(region.roi.size(), 1000U);
  const auto are_of = [&](const VertexSet& own, const VertexSet& fine) {
    return !own.empty() && std::all_of(own.begin(), own.end(), [&](Index c) {
      return std::binary_search(fine.begin(), fine.end(), surface().kept[c]);
    });
  };
  EXPECT_TRUE(are_of(region.belt, fine_.region.belt));
  ASSERT_EQ(region.handles.size(), 1U);
  EXPECT_TRUE(are_of(region.handles[0], fine_.region.handles[0]));
}

TEST_F(CoarseCylinder, CarriesEveryVertexRigidlyWhereItMovesRigidly) {
  const CoarseEmbedding& embedding = coarse_->level->embedding;
  const Matrix3d turn = AngleAxisd(2.0, Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  const Vector3d shift(3.0, -1.0, 2.0);
  CoarseEmbedding::Pose to = rest();
  for (std::size_t c = 0; c < surface().kept.size(); ++c) {
    const Vector3d& at = mesh_.positions[surface().kept[c]];
    to.displacement[c] = turn * at + shift - at;
    to.transforms[c] = turn;
  }
  std::vector<Vector3d> u(mesh_.vertex_count(), Vector3d::Zero());
  embedding.prolongate(embedding.motions(rest(), to), u);
  double off = 0.0;
  for (std::size_t v = 0; v < u.size(); ++v) {
    const Vector3d& at = mesh_.positions[v];
    off = std::max(off, (at + u[v] - turn * at - shift).norm());
  }
  EXPECT_LT(off, 1e-12);
  embedding.prolongate(embedding.motions(to, rest()), u);
  for (const Vector3d& back : u) EXPECT_LT(back.norm(), 1e-12);
}

// Restriction to the coarse proxy preserves the sum and the moment of the forces.
TEST_F(CoarseCylinder, GathersForcesWithTheirSumAndMoment) {
  const CoarseEmbedding& embedding = coarse_->level->embedding;
  std::vector<Vector3d> forces;
  std::vector<Vector3d> u;
  for (std::size_t v = 0; v < mesh_.vertex_count(); ++v) {
    const auto t = static_cast<double>(v);
    forces.emplace_back(std::sin(t), std::cos(3.0 * t), std::sin(0.1 * t));
    u.emplace_back(0.01 * std::cos(t), 0.0, 0.01 * std::sin(2.0 * t));
  }
  CoarseEmbedding::Pose pose = rest();
  for (std::size_t c = 0; c < surface().kept.size(); ++c) {
    pose.displacement[c] = Vector3d(0.1, 0.02 * std::sin(static_cast<double>(c)), 0.0);
  }
  const std::vector<Vector3d> gathered = embedding.restrict_forces(forces, u, pose);
  Vector3d sum = Vector3d::Zero();
  Vector3d moment = Vector3d::Zero();
  for (std::size_t v = 0; v < forces.size(); ++v) {
    sum += forces[v];
    moment += (mesh_.positions[v] + u[v]).cross(forces[v]);
  }
  for (std::size_t c = 0; c < gathered.size(); ++c) {
    sum -= gathered[c];
    moment -= place(c, pose).cross(gathered[c]);
  }
  EXPECT_LT(sum.norm(), 1e-9);
  EXPECT_LT(moment.norm(), 1e-8);
}

TEST_F(CoarseCylinder, ServesTheNextEditWithOtherWeights) {
  DeformOptions options;
  options.constraint_weight = 10.0;
  options.weights = LaplacianWeights::uniform;
  const EditSystem next(prepared_, mesh_.positions, test::ends_of_cylinder(mesh_), options, {});
  const auto coarse = coarse_region(next, 1000);
  ASSERT_NE(coarse, nullptr);
  EXPECT_EQ(coarse->level, coarse_->level);
  EXPECT_EQ(coarse->edit->options.weights, LaplacianWeights::uniform);
}

TEST_F(CoarseCylinder, HasTheSetsOfTheNextEdit) {
  EditRegion region = test::ends_of_cylinder(mesh_);
  std::swap(region.belt, region.handles[0]);
  std::erase_if(region.belt, [](Index v) { return v % 60 < 20; });
  const EditSystem next(prepared_, mesh_.positions, region, {}, {});
  const auto coarse = coarse_region(next, 1000);
  ASSERT_NE(coarse, nullptr);
  const CoarseSurface& surface = coarse->level->surface;
  EXPECT_NE(coarse->level, coarse_->level);
  EXPECT_EQ(coarse->edit->region.roi.size(), 1000U);
  const auto holds = [](const VertexSet& set, Index v) {
    return std::binary_search(set.begin(), set.end(), v);
  };
  for (Index v = 0; v < mesh_.vertex_count(); ++v) {
    const Index owner = surface.owners[v];
    ASSERT_NE(owner, kNoIndex);
    EXPECT_EQ(holds(coarse->edit->region.belt, owner), holds(region.belt, v));
    EXPECT_EQ(holds(coarse->edit->region.handles[0], owner), holds(region.handles[0], v));
  }
}

TEST_F(CoarseCylinder, IsMadeAnewOfOtherPositions) {
  Positions moved = mesh_.positions;
  for (Vector3d& p : moved) p.x() *= 1.5;
  const EditSystem next(prepared_, moved, test::ends_of_cylinder(mesh_), {}, {});
  PreparedRegion none(mesh_.topology());
  const EditSystem anew(none, moved, test::ends_of_cylinder(mesh_), {}, {});
  const auto coarse = coarse_region(next, 1000);
  ASSERT_NE(coarse, nullptr);
  EXPECT_EQ(coarse->level->surface.kept, coarse_region(anew, 1000)->level->surface.kept);
  EXPECT_EQ(coarse->level->surface.rest[0], moved[coarse->level->surface.kept[0]]);
}

// After landmarks are removed, the proxy may merge the vertices that it kept for them.
TEST_F(CoarseCylinder, IsMadeAnewWhereManyVerticesAreReleased) {
  PreparedRegion prepared(mesh_.topology());
  EditRegion region = test::ends_of_cylinder(mesh_);
  for (Index v = 2000; v < 2400; v += 2) {
    region.targets.push_back({{v, v, v}, {1.0, 0.0, 0.0}, mesh_.positions[v], 1.0});
  }
  const EditSystem with(prepared, mesh_.positions, region, {}, {});
  const auto held = coarse_region(with, 1000);
  ASSERT_NE(held, nullptr);
  const auto count_of = [](const CoarseRegion& coarse) {
    const std::vector<Index>& kept = coarse.level->surface.kept;
    return std::ranges::count_if(kept, [](Index v) { return v >= 2000 && v < 2400; });
  };
  EXPECT_GE(count_of(*held), 200);
  const EditSystem without(prepared, mesh_.positions, test::ends_of_cylinder(mesh_), {}, {});
  const auto released = coarse_region(without, 1000);
  ASSERT_NE(released, nullptr);
  EXPECT_EQ(released->level->surface.kept, surface().kept);
}

TEST_F(CoarseCylinder, IsNotThereWhereMostVerticesAreHeldOneByOne) {
  EditRegion region = test::ends_of_cylinder(mesh_);
  VertexSet free;
  std::set_difference(region.roi.begin(), region.roi.end(), region.belt.begin(), region.belt.end(),
                      std::back_inserter(free));
  region.handles.clear();
  for (const Index v : free) {
    if (v % 4 != 0) region.handles.push_back({v});
  }
  const EditSystem fine(prepared_, mesh_.positions, region, {}, {});
  EXPECT_EQ(coarse_region(fine, 1000), nullptr);
}

}  // namespace
}  // namespace lapwing
