// What the handles that scale ask of the surface, and what comes of it.
#include "lapwing/deform/rest_stretch.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/deform/deform.h"
#include "lapwing/deform/deform_solver.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/laplacian/rotation.h"
#include "lapwing/mesh/shapes.h"
#include "support/bent_tube.h"
#include "support/largest_distance.h"

namespace lapwing {
namespace {

using Eigen::Affine3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

// A tube along z, held at its foot, whose other end is a handle.
class ScaledTube : public ::testing::Test {
 protected:
  std::vector<Matrix3d> stretch(const Affine3d& motion) const {
    return DeformSolver(mesh_.positions, mesh_.topology(), region(), {}, kernels_)
        .rest_stretch(std::array{motion});
  }
  DeformResult deformed(const Affine3d& motion) const {
    return DeformSolver(mesh_.positions, mesh_.topology(), region(), {}, kernels_)
        .solve(std::array{motion});
  }
  EditRegion region() const {
    EditRegion region;
    region.handles.resize(1);
    for (Index v = 0; v < mesh_.vertex_count(); ++v) {
      const double z = mesh_.positions[v].z();
      region.roi.push_back(v);
      if (z < 0.5) region.belt.push_back(v);
      if (z > 5.5) region.handles[0].push_back(v);
    }
    return region;
  }
  Vector3d centroid() const {
    const EditRegion of = region();
    Vector3d sum = Vector3d::Zero();
    for (const Index v : of.handles[0]) sum += mesh_.positions[v];
    return sum / static_cast<double>(of.handles[0].size());
  }
  // About the handle's centroid.
  Affine3d scaled(const Vector3d& by) const {
    return Eigen::Translation3d(centroid()) * Eigen::Scaling(by) *
           Eigen::Translation3d(-centroid());
  }
  // How far the middle of any cross-section leaves the tube's axis.
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
  const Mesh mesh_ = rippled_cylinder(40, 81);
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

// Between belt and handle there is room to widen, and none to become longer.
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
  for (const double scale : {0.5, 1.5, 1.6, 2.0}) {
    const DeformResult result = deformed(scaled(Vector3d::Constant(scale)));
    EXPECT_TRUE(result.certificate.settled) << scale;
    EXPECT_EQ(result.certificate.flipped_triangles, 0U) << scale;
    EXPECT_LT(bend_of_axis(result.positions), 0.03) << scale;
  }
}

TEST_F(ScaledTube, StaysStraightWhenItsEndIsScaledAlongOneAxis) {
  for (const Vector3d& by :
       {Vector3d(2.0, 1.0, 1.0), Vector3d(1.0, 1.0, 2.0), Vector3d(1.0, 1.0, 0.5)}) {
    const DeformResult result = deformed(scaled(by));
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

TEST(PolarStretch, IsTheSymmetricFactorWithoutTheRotation) {
  const Eigen::AngleAxisd tilt(0.4, Vector3d(3.0, 1.0, 2.0).normalized());
  const Matrix3d P = tilt * Vector3d(2.0, 0.5, 1.0).asDiagonal() * tilt.inverse();
  const Matrix3d R = Eigen::AngleAxisd(2.2, Vector3d(1.0, 0.0, 1.0).normalized()).matrix();
  EXPECT_LT((polar_stretch(R * P) - P).norm(), 1e-12);
  EXPECT_LT((polar_stretch(-P) - P).norm(), 1e-12) << "of a mirror image";
  EXPECT_GE(polar_stretch(Matrix3d::Zero()).diagonal().minCoeff(), kLeastStretch);
}

}  // namespace
}  // namespace lapwing
