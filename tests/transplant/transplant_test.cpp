#include "lapwing/transplant/transplant.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/mesh/shapes.h"
#include "support/cancel_everywhere.h"
#include "support/environment.h"
#include "support/error_message.h"
#include "transplant/loops.h"

namespace lapwing {
namespace {

using test::Environment;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::Not;

TransplantRequest onto_the_pole(double scale = 1.0) {
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
  const TransplantRequest request = onto_the_pole();
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

// A tube whose rim is the loop; where `pierced`, with a hole in its side not far from that.
Mesh tube(bool pierced) {
  Mesh mesh = cylinder(24, 60, 0.3, 1.5);
  // The other end is closed.
  const auto tip = static_cast<Index>(mesh.vertex_count());
  mesh.positions.emplace_back(0.0, 0.0, 1.6);
  const Index last = tip - 24;
  for (Index a = 0; a < 24; ++a) mesh.add_face(std::array{last + a, last + (a + 1) % 24, tip});
  if (!pierced) return mesh;
  return test::with_hole(mesh, {0.3, 0.0, 0.1}, 0.04);
}

TEST(TransplantTransition, IsNarrowedBesideAHoleAndSaysSo) {
  const Mesh host = icosphere(4);
  const Transplanted whole = transplant(host, tube(false), onto_the_pole());
  EXPECT_THAT(texts_of(whole.report.warnings), Each(Not(HasSubstr("narrowed"))));
  const Transplanted pierced = transplant(host, tube(true), onto_the_pole());
  EXPECT_THAT(texts_of(pierced.report.warnings), Contains(HasSubstr("narrowed")));
  EXPECT_EQ(pierced.report.warnings.back().advice, Advice::set_transition_width);
  EXPECT_EQ(pierced.report.warnings.back().value, pierced.report.transition_width);
  EXPECT_LT(pierced.report.transition_width, 0.9 * whole.report.transition_width);
  EXPECT_GT(pierced.report.transition_width, 0.2 * whole.report.transition_width);
  EXPECT_LT(pierced.report.padding, whole.report.padding) << "what goes by it as well";
}

TEST(TransplantTransition, ThatIsGivenIsRefusedThere) {
  TransplantRequest request = onto_the_pole();
  request.parameters.transition =
      Transition{transplant(icosphere(4), tube(false), request).report.transition_width};
  EXPECT_THAT(error_message<InputError>([&] { transplant(icosphere(4), tube(true), request); }),
              HasSubstr("set its \"width\" below"));
}

}  // namespace
}  // namespace lapwing
