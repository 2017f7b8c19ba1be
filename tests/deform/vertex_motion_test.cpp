#include "lapwing/deform/vertex_motion.h"

#include <algorithm>
#include <array>
#include <numbers>

#include <gtest/gtest.h>

#include "lapwing/deform/deform.h"
#include "lapwing/deform/shape_measures.h"
#include "support/bent_tube.h"

namespace lapwing {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

RegionSpec below(double height) {
  return {Box{{-1, -1, -1}, {1, 1, height}}};
}
RegionSpec above(double height) {
  return {Box{{-1, -1, height}, {1, 1, 4}}};
}

DeformRequest bend(double degrees) {
  DeformRequest request;
  request.roi = {AllVertices{}};
  request.belt = below(0.4);
  request.handles = {
      {above(2.6), SimilarityMove{.translate = {0.5, 0.0, -0.2}, .rotate = {{0, 1, 0}, degrees}}}};
  return request;
}

TEST(VertexMotion, OfAllThatIsHeldMovingRigidlyIsOneQuaternionEverywhere) {
  const Mesh tube = cylinder(12, 20, 0.5, 3.0);
  const AxisRotation turn{{1, 2, -1}, 130.0};
  const SimilarityMove move{.translate = {3, -1, 2}, .rotate = turn, .pivot = Vector3d(0, 0, 1)};
  DeformRequest request;
  request.roi = {AllVertices{}};
  request.belt = RegionSpec{ListedVertices{}};
  request.handles = {{below(0.4), move}, {above(2.6), move}};
  const Deformed moved = deform(tube, request);
  const VertexMotion motion = vertex_motion(tube.positions, moved.mesh.positions, tube.topology());
  const Eigen::AngleAxisd asked(130.0 * std::numbers::pi / 180.0, turn.axis.normalized());
  const Quaterniond expected = unit_quaternion(asked.toRotationMatrix());
  for (std::size_t v = 0; v < tube.vertex_count(); ++v) {
    EXPECT_LT((motion.rotations[v].coeffs() - expected.coeffs()).norm(), 1e-9) << v;
    EXPECT_LT(motion.stretch[v], 1e-9) << v;
    EXPECT_EQ(motion.displacements[v], moved.mesh.positions[v] - tube.positions[v]) << v;
  }
}

TEST(VertexMotion, AgreesWithTheMeasuresOfTheCertificate) {
  const Mesh tube = cylinder(12, 20, 0.5, 3.0);
  const Deformed bent = deform(tube, bend(70.0));
  const VertexMotion motion = vertex_motion(tube.positions, bent.mesh.positions, tube.topology());
  const auto weights =
      laplacian_weights(tube.topology(), tube.positions, LaplacianWeights::cotangent);
  const VertexMeasures measures = measure_vertices(bent.region.roi, tube.topology(), weights,
                                                   tube.positions, bent.mesh.positions);
  double largest = 0.0;
  for (std::size_t r = 0; r < measures.vertices.size(); ++r) {
    const Index v = measures.vertices[r];
    const Quaterniond& q = motion.rotations[v];
    EXPECT_GE(q.w(), 0.0);
    EXPECT_NEAR(q.norm(), 1.0, 1e-14);
    const double degrees = 2.0 * std::atan2(q.vec().norm(), q.w()) * 180.0 / std::numbers::pi;
    EXPECT_NEAR(degrees, measures.rotation_degrees[r], 1e-9) << v;
    EXPECT_EQ(q.coeffs(), measures.rotation[r].coeffs()) << v;
    EXPECT_EQ(motion.displacements[v], measures.displacement[r]) << v;
    EXPECT_EQ(motion.stretch[v], measures.stretch[r]) << v;
    largest = std::max(largest, degrees);
  }
  EXPECT_NEAR(largest, bent.certificate.largest_rotation_degrees, 1e-9);
}

TEST(VertexMotion, OfWhatDoesNotMoveIsExactlyTheIdentity) {
  const Mesh tube = test::bumpy_tube();
  Positions dented = tube.positions;
  dented[100] *= 1.1;
  const Topology& topology = tube.topology();
  const VertexMotion all = vertex_motion(tube.positions, dented, topology);
  const std::array<Index, 1> row{100};
  const VertexMotion one = vertex_motion(row, tube.positions, dented, topology);
  for (Index v = 0; v < tube.vertex_count(); ++v) {
    const auto ring = topology.rings[v];
    const bool touched = v == 100 || std::find(ring.begin(), ring.end(), 100U) != ring.end();
    const bool is_still = all.rotations[v].coeffs() == Quaterniond::Identity().coeffs();
    EXPECT_TRUE(touched || is_still) << v;
    EXPECT_TRUE(v == 100 || one.rotations[v].coeffs() == Quaterniond::Identity().coeffs()) << v;
    EXPECT_EQ(one.displacements[v], all.displacements[v]);
  }
}

TEST(VertexMotion, SignOfAQuaternionIsChosenByItsFirstPart) {
  const auto turned = [](double angle, const Vector3d& axis) {
    return unit_quaternion(Eigen::AngleAxisd(angle, axis).toRotationMatrix());
  };
  EXPECT_GT(turned(3.0, -Vector3d::UnitZ()).w(), 0.0);
  EXPECT_LT(turned(3.0, -Vector3d::UnitZ()).z(), 0.0);
  EXPECT_GT(turned(-3.2, Vector3d::UnitX()).w(), 0.0);
  const Eigen::Matrix3d half_turn = Vector3d(-1, -1, 1).asDiagonal();
  EXPECT_EQ(unit_quaternion(half_turn).coeffs(), Eigen::Vector4d(0, 0, 1, 0));
}

}  // namespace
}  // namespace lapwing
