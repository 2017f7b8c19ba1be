#include "work/mesh_repair.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "doctor/broken_meshes.h"
#include "lapwing/base/errors.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/mesh/transform.h"
#include "support/joined_meshes.h"

namespace lapwing::viewer {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Not;

TEST(MeshRepair, LeavesNothingThatCanBeRepairedAndTheMeshAsItWas) {
  const Mesh mesh = unwelded_square();
  const RepairedMesh result = repaired(mesh, {});
  EXPECT_FALSE(result.left.is_fixable());
  EXPECT_TRUE(result.done.changed());
  EXPECT_EQ(result.mesh->vertex_count(), 4U);
  EXPECT_EQ(mesh.vertex_count(), 6U);
}

TEST(MeshRepair, CanBeGivenUp) {
  EXPECT_THROW(repaired(bow_tie(), [](std::string_view, double) { return false; }), Cancelled);
}

TEST(MeshRepair, FindsTheVerticesOfEachProblem) {
  Mesh mesh = grid(3, 3);
  mesh.positions[0].x() = std::numeric_limits<double>::quiet_NaN();
  const auto loose = static_cast<Index>(mesh.vertex_count());
  mesh.positions.emplace_back(7, 7, 7);
  const FaultyVertices faulty = faulty_vertices(mesh, check(mesh));
  EXPECT_THAT(faulty.hindering, ElementsAre(0));
  EXPECT_THAT(faulty.others, ElementsAre(loose));
  const std::vector<Index> places = places_of(mesh, faulty);
  EXPECT_THAT(places, Not(IsEmpty()));
  EXPECT_EQ(places.back(), loose);
  for (const Index v : places) EXPECT_TRUE(mesh.positions[v].allFinite());
  EXPECT_GT(places.size(), 1U) << "the neighbours of the one that is nowhere";
}

TEST(MeshRepair, ShowsAVertexOfEachInsideOutPart) {
  Mesh ball = icosphere(1);
  turn_inside_out(ball);
  EXPECT_THAT(faulty_vertices(ball, check(ball)).others, ElementsAre(0));
}

TEST(MeshRepair, FindsTheSideFromWhichPlacesShow) {
  Mesh ball = icosphere(3);
  std::vector<Index> cap;
  std::vector<Index> all;
  for (Index v = 0; v < ball.vertex_count(); ++v) {
    all.push_back(v);
    if (ball.positions[v].y() < -0.9) cap.push_back(v);
  }
  EXPECT_LT((side_of(ball, cap).value() + Eigen::Vector3d::UnitY()).norm(), 0.05);
  EXPECT_FALSE(side_of(ball, all)) << "they are all around";
  EXPECT_FALSE(side_of(ball, {}));
  for (auto& p : ball.positions) p = -p;  // turned inside out
  EXPECT_LT((side_of(ball, cap).value() - Eigen::Vector3d::UnitY()).norm(), 0.05);
}

TEST(MeshRepair, ASoundMeshHasNoFaultyVertices) {
  // Two components are worth knowing, and no fault.
  Mesh other = icosphere(1);
  transform(other, Eigen::Affine3d(Eigen::Translation3d(5, 0, 0)));
  const Mesh mesh = lapwing::test::joined(icosphere(1), other);
  const FaultyVertices faulty = faulty_vertices(mesh, check(mesh));
  EXPECT_THAT(faulty.hindering, IsEmpty());
  EXPECT_THAT(faulty.others, IsEmpty());
}

}  // namespace
}  // namespace lapwing::viewer
