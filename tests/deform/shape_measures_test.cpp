#include "lapwing/deform/shape_measures.h"

#include <cmath>
#include <numbers>
#include <numeric>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/laplacian/weights.h"
#include "support/bent_tube.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;
using ::testing::DoubleNear;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::Le;

class ShapeMeasures : public ::testing::Test {
 protected:
  ShapeMeasures() { std::iota(all_.begin(), all_.end(), 0U); }

  Positions moved(const Eigen::Affine3d& motion) const {
    Positions positions = rest_;
    for (Vector3d& p : positions) p = motion * p;
    return positions;
  }
  double detail(const Positions& current) const {
    return detail_error(all_, topology_, weights_, rest_, current);
  }
  double stretch(const Positions& current) const {
    return edge_stretch(all_, topology_, rest_, current);
  }
  StretchedEdge most_stretched(const Positions& current) const {
    return edge_stretches(all_, topology_, rest_, current).most;
  }

  VertexMeasures measure(const Positions& current) const {
    return measure_vertices(all_, topology_, weights_, rest_, current);
  }

  Mesh mesh_ = test::bumpy_tube();
  Topology topology_ = mesh_.topology();
  Positions rest_ = mesh_.positions;
  std::vector<double> weights_ = laplacian_weights(topology_, rest_, LaplacianWeights::uniform);
  std::vector<Index> all_ = std::vector<Index>(mesh_.vertex_count());
};

const Eigen::Affine3d kRigid =
    Eigen::Translation3d(1, 2, 3) * Eigen::AngleAxisd(2.5, Vector3d(1, 1, 0).normalized());

TEST_F(ShapeMeasures, RigidMotionChangesNothing) {
  EXPECT_LT(detail(moved(kRigid)), 1e-12);
  EXPECT_LT(stretch(moved(kRigid)), 1e-12);
  EXPECT_LT(most_stretched(moved(kRigid)).stretch, 1e-12);
}

TEST_F(ShapeMeasures, GrowthByAFactorIsThatMuchStretchAndDetail) {
  const Positions grown = moved(kRigid * Eigen::Scaling(1.25));
  EXPECT_NEAR(detail(grown), 0.25, 1e-12);
  EXPECT_NEAR(stretch(grown), 0.25, 1e-12);
  EXPECT_NEAR(most_stretched(grown).stretch, 0.25, 1e-12);
}

TEST_F(ShapeMeasures, VerticesOfARigidMotionHaveItsAngleAndNoError) {
  const VertexMeasures measures = measure(moved(kRigid));
  EXPECT_EQ(measures.vertices, all_);
  EXPECT_THAT(measures.rotation_degrees, Each(DoubleNear(2.5 * 180.0 / std::numbers::pi, 1e-9)));
  EXPECT_THAT(measures.detail_error, Each(Le(1e-12)));
  EXPECT_THAT(measures.stretch, Each(Le(1e-12)));
}

TEST_F(ShapeMeasures, RootMeanSquareOverTheVerticesIsTheDetailErrorOfTheRegion) {
  Positions bent = rest_;
  for (Vector3d& p : bent) p.x() += 0.1 * p.z() * p.z();
  const VertexMeasures measures = measure(bent);
  double sum = 0.0;
  for (const double error : measures.detail_error) sum += error * error;
  EXPECT_NEAR(std::sqrt(sum / static_cast<double>(all_.size())), detail(bent), 1e-12);
}

TEST_F(ShapeMeasures, OnlyRingsThatHoldAMovedVertexAreMeasuredAsChanged) {
  Positions dented = rest_;
  dented[100] *= 1.1;
  const VertexMeasures measures = measure(dented);
  for (const Index i : all_) {
    const auto ring = topology_.rings[i];
    const bool touched = i == 100 || std::find(ring.begin(), ring.end(), 100U) != ring.end();
    EXPECT_EQ(measures.stretch[i] > 0.0, touched) << i;
    EXPECT_EQ(measures.detail_error[i] > 1e-12, touched) << i;
  }
}

TEST_F(ShapeMeasures, FlatVerticesAreMeasuredAgainstTheDetailAroundThem) {
  // A flat sheet of which only the border has a Laplacian.
  mesh_ = grid(10, 10);
  topology_ = mesh_.topology();
  rest_ = mesh_.positions;
  weights_ = laplacian_weights(topology_, rest_, LaplacianWeights::uniform);
  all_.resize(mesh_.vertex_count());
  Positions raised = rest_;
  raised[60].z() += 0.01;
  EXPECT_LT(measure(raised).detail_error[60], 1.0);
  const std::array<Index, 1> flat{60};
  EXPECT_TRUE(
      std::isnan(measure_vertices(flat, topology_, weights_, rest_, raised).detail_error[0]))
      << "alone it has no detail around it";
}

// The Laplacian of the sheet is nonzero only because its coordinates are rounded.
TEST_F(ShapeMeasures, DetailOfAFlatSheetIsNotMeasurable) {
  for (const double digits : {1e6, 1e7, 1e16}) {
    mesh_ = grid(10, 10);
    const Eigen::AngleAxisd turn(0.7, Vector3d(1, 2, 3).normalized());
    for (Vector3d& p : mesh_.positions) {
      p = ((turn * p) * digits).array().round().matrix() / digits;
    }
    topology_ = mesh_.topology();
    rest_ = mesh_.positions;
    weights_ = laplacian_weights(topology_, rest_, LaplacianWeights::uniform);
    all_ = {58, 59, 60, 61, 62};
    Positions raised = rest_;
    raised[60] += turn * Vector3d(0, 0, 0.3);
    EXPECT_TRUE(std::isnan(detail(raised))) << digits;
    for (const double error : measure(raised).detail_error) EXPECT_TRUE(std::isnan(error));
    // A bump with a height of 0.01 edge lengths counts as detail.
    rest_[60] += turn * Vector3d(0, 0, 0.01 * (rest_[59] - rest_[60]).norm());
    EXPECT_TRUE(std::isfinite(detail(raised))) << digits;
  }
}

TEST_F(ShapeMeasures, MostStretchedEdgeIsTheOneThatWasPulled) {
  Positions pulled = rest_;
  const Index end = topology_.rings[100].back();
  pulled[100] += 3.0 * (pulled[100] - pulled[end]);
  const StretchedEdge edge = most_stretched(pulled);
  EXPECT_NEAR(edge.stretch, 3.0, 1e-12);
  EXPECT_THAT(edge.vertices, ElementsAre(100U, end));
}

TEST_F(ShapeMeasures, EdgesWithoutLengthDoNotCount) {
  const Index twin = topology_.rings[100].back();
  rest_[twin] = rest_[100];
  Positions apart = rest_;
  EXPECT_EQ(most_stretched(apart).vertices[0], kNoIndex) << "nothing has changed";
  apart[twin].z() += 1e-3;
  EXPECT_LT(most_stretched(apart).stretch, 0.1);
  EXPECT_LT(stretch(apart), 0.1);
}

}  // namespace
}  // namespace lapwing
