#include "lapwing/deform/coarse_region.h"

#include <numeric>

#include <gtest/gtest.h>

#include "lapwing/deform/prepared_region.h"
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
    return {std::vector<Vector3d>(coarse_->kept.size(), Vector3d::Zero()),
            std::vector<Matrix3d>(coarse_->kept.size(), Matrix3d::Identity())};
  }
  Vector3d place(std::size_t own, const CoarseEmbedding::Pose& pose) const {
    return mesh_.positions[coarse_->kept[own]] + pose.displacement[own];
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
      return std::binary_search(fine.begin(), fine.end(), coarse_->kept[c]);
    });
  };
  EXPECT_TRUE(are_of(region.belt, fine_.region.belt));
  ASSERT_EQ(region.handles.size(), 1U);
  EXPECT_TRUE(are_of(region.handles[0], fine_.region.handles[0]));
}

TEST_F(CoarseCylinder, CarriesEveryVertexRigidlyWhereItMovesRigidly) {
  const CoarseEmbedding embedding(fine_, *coarse_);
  const Matrix3d turn = AngleAxisd(2.0, Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  const Vector3d shift(3.0, -1.0, 2.0);
  CoarseEmbedding::Pose to = rest();
  for (std::size_t c = 0; c < coarse_->kept.size(); ++c) {
    const Vector3d& at = mesh_.positions[coarse_->kept[c]];
    to.displacement[c] = turn * at + shift - at;
    to.transforms[c] = turn;
  }
  std::vector<Vector3d> u(mesh_.vertex_count(), Vector3d::Zero());
  embedding.carry(rest(), to, u);
  double off = 0.0;
  for (std::size_t v = 0; v < u.size(); ++v) {
    const Vector3d& at = mesh_.positions[v];
    off = std::max(off, (at + u[v] - turn * at - shift).norm());
  }
  EXPECT_LT(off, 1e-12);
  embedding.carry(to, rest(), u);
  for (const Vector3d& back : u) EXPECT_LT(back.norm(), 1e-12);
}

// What the forces do in any rigid motion is kept: their sum and their moment.
TEST_F(CoarseCylinder, GathersForcesWithTheirSumAndMoment) {
  const CoarseEmbedding embedding(fine_, *coarse_);
  std::vector<Vector3d> forces;
  std::vector<Vector3d> u;
  for (std::size_t v = 0; v < mesh_.vertex_count(); ++v) {
    const auto t = static_cast<double>(v);
    forces.emplace_back(std::sin(t), std::cos(3.0 * t), std::sin(0.1 * t));
    u.emplace_back(0.01 * std::cos(t), 0.0, 0.01 * std::sin(2.0 * t));
  }
  CoarseEmbedding::Pose pose = rest();
  for (std::size_t c = 0; c < coarse_->kept.size(); ++c) {
    pose.displacement[c] = Vector3d(0.1, 0.02 * std::sin(static_cast<double>(c)), 0.0);
  }
  const std::vector<Vector3d> gathered = embedding.gather(forces, u, pose);
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
