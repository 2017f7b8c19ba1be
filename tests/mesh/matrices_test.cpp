#include "lapwing/mesh/matrices.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/mesh/shapes.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

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
