#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/limits.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/remesh/remesh.h"
#include "support/cancel_everywhere.h"
#include "support/environment.h"
#include "support/error_message.h"

// Remeshing that is cancelled, and that would make too much.
namespace lapwing::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

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
