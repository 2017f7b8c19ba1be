#include "lapwing/transplant/zip.h"

#include <map>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/mesh/compact.h"
#include "support/error_message.h"
#include "transplant/loop_scenes.h"

namespace lapwing {
namespace {

using Eigen::Affine3d;
using Eigen::AngleAxisd;
using Eigen::Translation3d;
using Eigen::Vector3d;
using test::circle;
using test::Curve;
using test::flat_part;
using test::hole_in_sheet;
using test::manifold_faults;
using test::polar;
using test::Rim;
using test::saddle;
using test::star;
using test::upright_part;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

// A way for two loops to lie to each other.
struct Scene {
  std::string name;
  Curve host, part;
  bool upright = false;
  bool flat = false;  // in the plane, the part's loop inside the host's: no triangle need turn over

  friend void PrintTo(const Scene& scene, std::ostream* out) { *out << scene.name; }
  Rim make_host(Index count, double start = 0.0) const { return hole_in_sheet(count, host, start); }
  Rim make_part(Index count, double start = 0.0) const {
    return upright ? upright_part(count, part, start) : flat_part(count, part, start);
  }
};

std::vector<Scene> scenes() {
  const auto tilt = AngleAxisd(0.5, Vector3d::UnitX());
  const Affine3d aside = Affine3d(Translation3d(0.35, 0.2, 0.0));
  return {
      {"concentric", circle(1.0), circle(0.6), false, true},
      {"narrow", circle(1.0), circle(0.97), false, false},
      {"aside", circle(1.0), test::moved(circle(0.4), aside), false, true},
      {"above", circle(1.0), circle(1.0, 0.4), true},
      {"touching", circle(1.0), circle(1.0), true},
      {"tilted", circle(1.0), test::moved(circle(0.8, 0.6), Affine3d(tilt)), true},
      {"saddle", saddle(1.0, 0.4), circle(0.8, 0.5), true},
      {"saddles", saddle(1.0, 0.4),
       test::moved(saddle(0.8, 0.4, 0.6), Affine3d(AngleAxisd(1.0, Vector3d::UnitZ()))), true},
      {"star", circle(1.2), star(0.3, 0.9, 5), false, false},
      {"star_in_star", star(1.1, 2.0, 7), star(0.3, 0.9, 7), false, false},
      {"star_hole", star(0.5, 1.5, 6), circle(0.4), false, false},
      {"too_large", circle(1.0), circle(1.6, 0.3), true},
      {"crossing", circle(1.0), test::moved(circle(1.0), aside), false},
  };
}

using Counts = std::array<Index, 2>;
std::vector<Counts> count_pairs() {
  return {{3, 3},   {3, 4},    {5, 3},    {4, 17},    {17, 17},    {3, 64},    {64, 17},
          {64, 64}, {10, 500}, {500, 64}, {500, 500}, {100, 5000}, {5000, 500}};
}

class ZipPairs : public ::testing::TestWithParam<std::tuple<Scene, Counts>> {
 protected:
  Scene scene = std::get<0>(GetParam());
  Rim host = scene.make_host(std::get<1>(GetParam())[0], 0.1);
  Rim part = scene.make_part(std::get<1>(GetParam())[1], 0.7);
};

TEST_P(ZipPairs, AreOneOrientedRing) {
  const Joined joined = test::join(host, part, test::zip(host, part));
  EXPECT_THAT(manifold_faults(joined.mesh), IsEmpty());
  const CheckReport report = check(joined.mesh, build_topology(joined.mesh));
  EXPECT_EQ(report.statistics.euler_characteristic, 0);
  EXPECT_EQ(report.statistics.boundary_loops, 2U);
  EXPECT_EQ(report.statistics.component_sizes.size(), 1U);
}

TEST_P(ZipPairs, DoNotFoldWhereTheyNeedNot) {
  if (!scene.flat || std::get<1>(GetParam())[0] < 17 || std::get<1>(GetParam())[1] < 17) {
    GTEST_SKIP() << "coarse polygons cross each other";
  }
  const Joined joined = test::join(host, part, test::zip(host, part));
  for (const Index face : joined.strip_faces) {
    ASSERT_GT(test::area_vector(joined.mesh, face).z(), 0.0) << face;
  }
}

INSTANTIATE_TEST_SUITE_P(All, ZipPairs,
                         ::testing::Combine(::testing::ValuesIn(scenes()),
                                            ::testing::ValuesIn(count_pairs())),
                         [](const auto& test) {
                           const Counts counts = std::get<1>(test.param);
                           return std::get<0>(test.param).name + "_" + std::to_string(counts[0]) +
                                  "_" + std::to_string(counts[1]);
                         });

}  // namespace
}  // namespace lapwing
