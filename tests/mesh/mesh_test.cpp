#include "lapwing/mesh/mesh.h"

#include <stdexcept>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/deform/deform.h"
#include "lapwing/mesh/matrices.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/mesh/topology.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

using ::testing::ElementsAre;

TEST(MeshSharing, CopyWithOtherPositionsHasTheSameTopology) {
  const Mesh mesh = grid(4, 4);
  Mesh moved = mesh;
  moved.positions[7].z() = 1.0;
  EXPECT_EQ(&moved.topology(), &mesh.topology());
  EXPECT_TRUE(moved.shares_faces_with(mesh));
  EXPECT_EQ(mesh.positions[7].z(), 0.0);
}

TEST(MeshSharing, CopyThatEditsItsFacesLeavesTheOtherAsItIs) {
  const Mesh mesh = grid(2, 2);
  const std::vector<Index> before = mesh.face_vertices();
  const Topology& topology = mesh.topology();
  Mesh other = mesh;
  other.add_face(std::array<Index, 3>{0, 1, 2});
  EXPECT_EQ(mesh.face_vertices(), before);
  EXPECT_EQ(&mesh.topology(), &topology);
  EXPECT_FALSE(other.shares_faces_with(mesh));
  EXPECT_EQ(other.topology().triangles.size(), topology.triangles.size() + 1);
}

TEST(MeshSharing, EditOfFacesEndsTheirTopology) {
  Mesh mesh = grid(1, 1);
  EXPECT_EQ(mesh.topology().triangles.size(), 2U);
  mesh.edit_faces() = {};
  EXPECT_EQ(mesh.topology().triangles.size(), 0U);
}

TEST(MeshSharing, CopyThatEditsItsAttributesLeavesTheOtherAsItIs) {
  Mesh mesh = grid(1, 1);
  mesh.edit_attributes().comments = {"first"};
  Mesh other = mesh;
  other.edit_attributes().comments.emplace_back("second");
  EXPECT_THAT(mesh.attributes().comments, ElementsAre("first"));
  EXPECT_THAT(other.attributes().comments, ElementsAre("first", "second"));
}

TEST(MeshSharing, MeshThatWasMovedFromIsEmpty) {
  Mesh mesh = grid(1, 1);
  const Mesh taken = std::move(mesh);
  EXPECT_EQ(taken.face_count(), 2U);
  EXPECT_EQ(mesh.face_count(), 0U);  // NOLINT(bugprone-use-after-move)
  EXPECT_THROW(mesh.topology(), std::logic_error);
  mesh = grid(2, 1);
  EXPECT_EQ(mesh.topology().triangles.size(), 4U);
}

TEST(MeshSharing, VerticesAddedSinceTheTopologyWasBuiltAreAnError) {
  Mesh mesh = grid(1, 1);
  mesh.topology();
  mesh.positions.emplace_back(2, 2, 2);
  EXPECT_THROW(mesh.topology(), std::logic_error);
  mesh.edit_faces();
  EXPECT_EQ(mesh.topology().vertex_count(), 5U);
}

TEST(MeshSharing, ThreadsMayAskForTheTopologyAtOnce) {
  const Mesh mesh = grid(100, 100);
  std::array<const Topology*, 4> seen{};
  std::vector<std::thread> threads;
  for (const Topology*& one : seen) threads.emplace_back([&] { one = &mesh.topology(); });
  for (std::thread& thread : threads) thread.join();
  EXPECT_THAT(seen, ::testing::Each(&mesh.topology()));
}

TEST(MeshSharing, TopologyOutlivesItsMeshWhereItIsHeld) {
  std::shared_ptr<const Topology> held;
  {
    const Mesh mesh = grid(1, 1);
    held = mesh.shared_topology();
  }
  EXPECT_EQ(held->triangles.size(), 2U);
}

TEST(MeshSharing, ResultOfADeformationSharesAllButItsPositions) {
  Mesh mesh = grid(10, 10);
  mesh.edit_attributes().comments = {"kept"};
  DeformRequest request;
  request.roi = {GeodesicDisk{60U, 0.4}};
  request.handles = {{{GeodesicDisk{60U, 0.1}}, SimilarityMove{.translate = {0, 0, 0.2}}}};
  const Deformed raised = deform(mesh, request);
  EXPECT_NE(raised.mesh.positions, mesh.positions);
  EXPECT_TRUE(raised.mesh.shares_faces_with(mesh));
  EXPECT_EQ(&raised.mesh.attributes(), &mesh.attributes());
}

TEST(Matrices, GiveTheMeshBack) {
  const Mesh mesh = icosphere(2);
  const Mesh again = mesh_of(vertex_matrix(mesh), triangle_matrix(mesh));
  EXPECT_EQ(again.positions, mesh.positions);
  EXPECT_EQ(again.face_vertices(), mesh.face_vertices());
}

TEST(Matrices, RefuseAVertexThatIsNotThere) {
  const Mesh mesh = grid(1, 1);
  Eigen::MatrixX3i F = triangle_matrix(mesh);
  for (const int wrong : {-1, 4}) {
    F(1, 2) = wrong;
    EXPECT_THAT(
        error_message<InputError>([&] { mesh_of(vertex_matrix(mesh), F); }),
        ::testing::HasSubstr("row 1 has vertex " + std::to_string(wrong) + ", but V has 4 rows"));
  }
}

}  // namespace
}  // namespace lapwing
