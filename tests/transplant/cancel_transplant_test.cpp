#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/transplant/transplant.h"
#include "support/cancel_everywhere.h"
#include "support/environment.h"
#include "support/error_message.h"

// A transplant that is cancelled, and one that would make too much.
namespace lapwing {
namespace {

using test::Environment;
using ::testing::AllOf;
using ::testing::HasSubstr;

TransplantRequest onto_the_pole(double scale) {
  TransplantRequest request;
  request.target_region.form = GeodesicDisk{Eigen::Vector3d(0.0, 0.0, 1.0), 0.5};
  request.place = LoopFit{.scale = scale};
  return request;
}

TEST(CancelTransplant, AtEveryPointLeavesBothMeshesAsTheyWere) {
  const Mesh host = icosphere(3);
  const Mesh part = cylinder(16, 30, 0.3, 1.5);
  const Positions of_host = host.positions;
  const Positions of_part = part.positions;
  const TransplantRequest request = onto_the_pole(1.0);
  const Transplanted whole = transplant(host, part, request);
  EXPECT_GT(whole.report.remeshed_vertices, 0U) << "all that a transplant can do is done";
  CpuKernels kernels;
  Transplanted done;
  EXPECT_GT(test::cancel_everywhere([&](const Progress& progress) {
              done = transplant(host, part, "part", request, kernels, progress);
            }),
            50U);
  EXPECT_EQ(host.positions, of_host);
  EXPECT_EQ(part.positions, of_part);
  EXPECT_EQ(done.placed, whole.placed);
}

TEST(TransplantLimits, APartManyTimesTooLargeIsRefusedBeforeItsSeamIsCut) {
  const Mesh host = icosphere(2);
  const Mesh part = cylinder(16, 30, 0.3, 1.5);
  for (const double scale : {168.0, 1000.0}) {
    EXPECT_THAT(error_message<InputError>([&] { transplant(host, part, onto_the_pole(scale)); }),
                AllOf(HasSubstr("transplant: the seam between mesh and part would get about"),
                      HasSubstr("more than the limit of 200,000; make the part smaller"),
                      HasSubstr("set LAPWING_MOST_SEAM_TRIANGLES to a larger number")))
        << scale;
  }
  EXPECT_NO_THROW(transplant(host, part, onto_the_pole(4.0)));
}

}  // namespace
}  // namespace lapwing
