#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/transplant/transplant.h"
#include "support/error_message.h"
#include "transplant/pierced.h"

// A transition where something lies in its way.
namespace lapwing {
namespace {

using ::testing::Contains;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::Not;

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

TransplantRequest onto_the_pole() {
  TransplantRequest request;
  request.target_region.form = GeodesicDisk{Eigen::Vector3d(0.0, 0.0, 1.0), 0.5};
  request.place = LoopFit{};
  return request;
}

TEST(TransplantTransition, IsNarrowedBesideAHoleAndSaysSo) {
  const Mesh host = icosphere(4);
  const Transplanted whole = transplant(host, tube(false), onto_the_pole());
  EXPECT_THAT(whole.warnings, Each(Not(HasSubstr("narrowed"))));
  const Transplanted pierced = transplant(host, tube(true), onto_the_pole());
  EXPECT_THAT(pierced.warnings, Contains(HasSubstr("narrowed")));
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
