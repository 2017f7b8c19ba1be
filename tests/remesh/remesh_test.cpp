// Remeshing as a function of a mesh and a request.
#include "lapwing/remesh/remesh.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/mesh/shapes.h"
#include "remesh/remesh_checks.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

using namespace test;
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

TEST_F(RemeshInMemory, ReportsItsProgressAndCanBeCancelled) {
  double last = -1.0;
  remesh(mesh_, of_the_middle(), [&](std::string_view, double fraction) {
    last = fraction;
    return true;
  });
  EXPECT_EQ(last, 1.0);
  const auto stop = [](std::string_view, double) { return false; };
  EXPECT_THROW(remesh(mesh_, of_the_middle(), stop), Cancelled);
}

TEST_F(RemeshInMemory, VertexWithoutAFinitePositionIsNamed) {
  Mesh mesh = grid(8, 8);
  mesh.positions[30].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(error_message<InputError>([&] { remesh(mesh, {}); }),
              AllOf(HasSubstr("non-finite position"), HasSubstr("vertex 30")));
}

}  // namespace
}  // namespace lapwing
