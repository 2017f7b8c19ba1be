// Tests the rest stretch of handles that scale, and its effect on the surface.
#include "lapwing/deform/rest_stretch.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/deform/deform.h"
#include "lapwing/deform/deform_solver.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/mesh/shapes.h"
#include "support/rippled_cylinder.h"

namespace lapwing {
namespace {

using Eigen::Affine3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

// A tube along z, held at its foot, whose other end is a handle.
class ScaledTube : public ::testing::Test {
 protected:
  DeformSolver solver() const { return {mesh_.positions, mesh_.topology(), region_, {}, kernels_}; }
  std::vector<Matrix3d> stretch(const Affine3d& motion) const {
    return solver().rest_stretch(std::array{motion});
  }
  // About the handle's centroid.
  Affine3d scaled(const Vector3d& by) const {
    const Vector3d centroid = handle_frame(region_.handles[0], mesh_.positions).centroid;
    return Eigen::Translation3d(centroid) * Eigen::Scaling(by) * Eigen::Translation3d(-centroid);
  }
  // Returns the largest distance of a cross-section's centre from the axis of the tube.
  double bend_of_axis(const Positions& positions) const {
    double largest = 0.0;
    for (double z = 0.25; z < 6.0; z += 0.25) {
      Vector3d was = Vector3d::Zero();
      Vector3d is = Vector3d::Zero();
      double count = 0.0;
      for (std::size_t v = 0; v < positions.size(); ++v) {
        if (std::abs(mesh_.positions[v].z() - z) > 0.2) continue;
        was += mesh_.positions[v];
        is += positions[v];
        ++count;
      }
      largest = std::max(largest, (is - was).head<2>().norm() / count);
    }
    return largest;
  }

  mutable CpuKernels kernels_;
  const Mesh mesh_ = test::rippled_cylinder(40, 81);
  const EditRegion region_ = test::ends_of_cylinder(mesh_, 0.5, 5.5);
};

TEST_F(ScaledTube, AsksForNoStretchUnlessTheHandleChangesItsSize) {
  EXPECT_THAT(stretch(Affine3d::Identity()), ::testing::IsEmpty());
  const Affine3d rigid = Eigen::Translation3d(1.0, 2.0, 3.0) *
                         Eigen::AngleAxisd(2.0, Vector3d(1.0, 1.0, 0.0).normalized());
  EXPECT_THAT(stretch(rigid), ::testing::IsEmpty());
  EXPECT_THAT(stretch(rigid * Eigen::Scaling(1.1)), ::testing::Not(::testing::IsEmpty()));
}

TEST_F(ScaledTube, StretchesAreSymmetricPositiveAndDoNotDependOnWhereTheHandleGoes) {
  const Affine3d grow = scaled({1.5, 0.7, 2.0});
  const std::vector<Matrix3d> all = stretch(grow);
  for (const Matrix3d& S : all) {
    EXPECT_LT((S - S.transpose()).norm(), 1e-12);
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Matrix3d>(S).eigenvalues().minCoeff(), 0.1);
  }
  const Affine3d elsewhere =
      Eigen::Translation3d(1.0, -2.0, 0.5) * Eigen::AngleAxisd(1.0, Vector3d::UnitY()) * grow;
  const std::vector<Matrix3d> same = stretch(elsewhere);
  for (std::size_t v = 0; v < all.size(); ++v) EXPECT_LT((all[v] - same[v]).norm(), 1e-9);
}

// Between belt and handle, the tube can become wider but not longer.
TEST_F(ScaledTube, IsAskedToWidenAndNotToGrowAlong) {
  const std::vector<Matrix3d> all = stretch(scaled(Vector3d::Constant(2.0)));
  for (std::size_t v = 0; v < all.size(); ++v) {
    const Vector3d& p = mesh_.positions[v];
    if (p.z() < 4.4 || p.z() > 4.8) continue;
    const Vector3d around = Vector3d(-p.y(), p.x(), 0.0).normalized();
    EXPECT_GT(around.dot(all[v] * around), 1.1) << "vertex " << v;
    EXPECT_LT(all[v](2, 2), 1.02) << "vertex " << v;
  }
}

TEST_F(ScaledTube, StaysStraightAndUnfoldedWhenItsEndIsScaled) {
  for (const Vector3d& by : {Vector3d(0.5, 0.5, 0.5), Vector3d(1.6, 1.6, 1.6), Vector3d(2, 2, 2),
                             Vector3d(2, 1, 1), Vector3d(1, 1, 2), Vector3d(1, 1, 0.5)}) {
    const DeformResult result = solver().solve(std::array{scaled(by)});
    EXPECT_TRUE(result.certificate.settled) << by.transpose();
    EXPECT_EQ(result.certificate.flipped_triangles, 0U) << by.transpose();
    EXPECT_LT(bend_of_axis(result.positions), 0.03) << by.transpose();
  }
}

// Two caps hold a sphere alone and move alike, so that all of it is scaled and turned, in parts
// that each turn the axes along which the next one scales.
TEST(StretchInParts, OfAScaledTurnIsTheScale) {
  const Mesh sphere = icosphere(3);
  VertexSet top;
  VertexSet bottom;
  for (Index v = 0; v < sphere.vertex_count(); ++v) {
    if (sphere.positions[v].z() > 0.8) top.push_back(v);
    if (sphere.positions[v].z() < -0.8) bottom.push_back(v);
  }
  const SimilarityMove move{.rotate = {Vector3d::UnitX(), 260.0},
                            .scale = Vector3d(1.0, 1.0, 2.0),
                            .pivot = Vector3d::Zero()};
  DeformRequest request;
  request.roi = {AllVertices{}};
  request.handles = {{{ListedVertices{top}}, move}, {{ListedVertices{bottom}}, move}};
  const Deformed turned = deform(sphere, request);
  ASSERT_GT(turned.commits, 1U);
  const Matrix3d scale = move.scale.asDiagonal();
  const Eigen::Affine3d map = to_affine(move, Vector3d::Zero());
  for (Index v = 0; v < sphere.vertex_count(); ++v) {
    EXPECT_LT((turned.mesh.positions[v] - map * sphere.positions[v]).norm(), 1e-3) << v;
    EXPECT_LT((turned.rest_stretch[v] - scale).norm(), 1e-3) << v;
  }
  EXPECT_LT(turned.certificate.detail_error, 1e-3);
}

}  // namespace
}  // namespace lapwing
