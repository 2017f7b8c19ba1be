// Remeshing as a function of a mesh and a request.
#include "lapwing/remesh/remesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/base/limits.h"
#include "lapwing/mesh/shapes.h"
#include "remesh/remesh_checks.h"
#include "support/cancel_everywhere.h"
#include "support/environment.h"
#include "support/error_message.h"

namespace lapwing::test {
namespace {

using Eigen::Vector3d;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

class RemeshInMemory : public ::testing::Test {
 protected:
  static RemeshRequest of_the_middle() {
    RemeshRequest request;
    request.region = {Box{{0.25, 0.25, -1.0}, {0.75, 0.75, 1.0}}};
    return request;
  }

  const Mesh mesh_ = bumpy_plane(20, 3, 0.1);
};

TEST_F(RemeshInMemory, IsIsotropicRemeshingWithOneLength) {
  RemeshRequest request = of_the_middle();
  request.length = 0.03;
  request.options.iterations = 3;
  const Remeshed done = remesh(mesh_, request);
  const VertexSet region = resolve(request.region, mesh_);
  const RemeshResult expected = remesh_isotropic(mesh_, region, everywhere(0.03), request.options);
  EXPECT_EQ(done.mesh.positions, expected.mesh.positions);
  EXPECT_EQ(done.mesh.face_vertices(), expected.mesh.face_vertices());
  EXPECT_EQ(done.kept, expected.kept);
  EXPECT_EQ(done.region, expected.region);
  expect_outside_unchanged(mesh_, region, {done.mesh, done.kept, done.region, {}});
  EXPECT_EQ(done.before.faces, region_quality(mesh_, region).faces);
  EXPECT_EQ(done.after.faces, region_quality(done.mesh, done.region).faces);
  EXPECT_GT(done.after.faces, 2 * done.before.faces);
  EXPECT_THAT(done.warnings, IsEmpty());
}

TEST_F(RemeshInMemory, AScaleIsALengthInMeanEdgesOfTheRegion) {
  RemeshRequest by_scale = of_the_middle();
  by_scale.scale = 0.6;
  const Remeshed scaled = remesh(mesh_, by_scale);
  RemeshRequest by_length = of_the_middle();
  by_length.length = 0.6 * scaled.before.mean_edge;
  by_length.scale = 7.0;  // means nothing beside a length
  const Remeshed measured = remesh(mesh_, by_length);
  EXPECT_EQ(measured.mesh.positions, scaled.mesh.positions);
  EXPECT_EQ(measured.mesh.face_vertices(), scaled.mesh.face_vertices());
  EXPECT_NE(remesh(mesh_, of_the_middle()).mesh.face_count(), scaled.mesh.face_count());
}

TEST_F(RemeshInMemory, WarnsOfARegionWithoutFaces) {
  RemeshRequest request;
  request.region = {ListedVertices{{3, 40}}};
  const Remeshed done = remesh(mesh_, request);
  EXPECT_EQ(done.mesh.positions, mesh_.positions);
  EXPECT_EQ(done.before.faces, 0U);
  EXPECT_THAT(done.warnings, ElementsAre(HasSubstr("nothing was remeshed")));
}

TEST_F(RemeshInMemory, RefusesWhatItCannotDoByName) {
  RemeshRequest beyond;
  beyond.region = {ListedVertices{{999999}}, "the sheet"};
  EXPECT_THAT(error_message<InputError>([&] { remesh(mesh_, beyond); }),
              AllOf(StartsWith("the sheet/vertices/0: "), HasSubstr("999999")));
  RemeshRequest negative;
  negative.length = -1.0;
  EXPECT_THAT(error_message<InputError>([&] { remesh(mesh_, negative); }),
              HasSubstr("is -1; it must be positive"));
  Mesh point = grid(3, 3);
  for (Vector3d& p : point.positions) p.setZero();
  RemeshRequest scaled;
  EXPECT_THAT(error_message<InputError>([&] { remesh(point, scaled); }),
              AllOf(StartsWith("remesh: "), HasSubstr("edges have length 0")));
  scaled.where = "the scale";
  EXPECT_THAT(error_message<InputError>([&] { remesh(point, scaled); }), StartsWith("the scale: "));
}

TEST(CancelRemesh, AtEveryPointLeavesTheMeshAsItWas) {
  const Mesh mesh = bumpy_plane(20, 3, 0.1);
  RemeshRequest request;
  request.scale = 0.7;
  request.options.iterations = 2;
  const Positions whole = remesh(mesh, request).mesh.positions;
  Positions done;
  EXPECT_GT(cancel_everywhere([&](const Progress& progress) {
              done = remesh(mesh, request, progress).mesh.positions;
            }),
            20U);
  EXPECT_EQ(mesh.positions, bumpy_plane(20, 3, 0.1).positions);
  EXPECT_EQ(done, whole);
}

TEST(RemeshLimits, MoreTrianglesThanAllowedAreRefusedByNumber) {
  RemeshRequest request;
  request.length = 0.01;
  const Environment lower(kMostTriangles.variable, "10000");
  EXPECT_THAT(error_message<InputError>([&] { remesh(grid(10, 10), request); }),
              AllOf(HasSubstr("remeshing to this edge length would make about"),
                    HasSubstr("more than the limit of 10,000; choose a greater length"),
                    HasSubstr("set LAPWING_MOST_TRIANGLES to a larger number")));
  request.length = 0.05;
  EXPECT_NO_THROW(remesh(grid(10, 10), request));
}

TEST(RemeshLimits, TheMemoryIsKnownBeforeItIsTaken) {
  RemeshRequest request;
  request.length = 0.01;
  const Environment little(kMemoryVariable, "1000000");
  EXPECT_THAT(error_message<SolverError>([&] { remesh(grid(10, 10), request); }),
              HasSubstr("remeshing to this edge length needs"));
}

}  // namespace
}  // namespace lapwing::test
