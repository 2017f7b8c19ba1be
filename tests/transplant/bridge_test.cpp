#include "lapwing/transplant/bridge.h"

#include <map>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
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
using test::Rim;
using test::saddle;
using test::star;
using test::upright_part;
using ::testing::AllOf;
using ::testing::Combine;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using ::testing::ValuesIn;

// A way for two loops to lie to each other.
struct Scene {
  std::string name;
  Curve host, part;
  bool upright = false;  // the part goes up from its loop; else it lies in the plane

  friend void PrintTo(const Scene& scene, std::ostream* out) { *out << scene.name; }
  Rim make_host(Index count, double start = 0.0) const { return hole_in_sheet(count, host, start); }
  Rim make_part(Index count, double start = 0.0) const {
    return upright ? upright_part(count, part, start) : flat_part(count, part, start);
  }
};

Affine3d aside(double x, double y, double z) {
  return Affine3d(Translation3d(x, y, z));
}

// The part's loop inside the host's, in one plane.
std::vector<Scene> flat_scenes() {
  return {{"concentric", circle(1.0), circle(0.6)},
          {"aside", circle(1.0), test::moved(circle(0.4), aside(0.35, 0.2, 0.0))},
          {"star", circle(1.2), star(0.3, 0.9, 5)},
          {"star_in_star", star(1.1, 2.0, 7), star(0.3, 0.9, 7)},
          {"star_hole", star(0.5, 1.5, 6), circle(0.4)}};
}

std::vector<Scene> scenes() {
  const auto tilt = Affine3d(AngleAxisd(0.5, Vector3d::UnitX()));
  const auto turn = Affine3d(AngleAxisd(1.0, Vector3d::UnitZ()));
  std::vector<Scene> all = flat_scenes();
  const std::vector<Scene> others = {
      {"narrow", circle(1.0), circle(0.97)},
      {"above", circle(1.0), circle(1.0, 0.4), true},
      {"touching", circle(1.0), circle(1.0), true},
      {"tilted", circle(1.0), test::moved(circle(0.8, 0.6), tilt), true},
      {"saddle", saddle(1.0, 0.4), circle(0.8, 0.5), true},
      {"saddles", saddle(1.0, 0.4), test::moved(saddle(0.8, 0.4, 0.6), turn), true},
      {"too_large", circle(1.0), circle(1.6, 0.3), true},
      {"crossing", circle(1.0), test::moved(circle(1.0), aside(0.35, 0.2, 0.0))},
      {"far_off", circle(1.0), test::moved(circle(0.1), aside(9.0, 0.0, 5.0)), true}};
  all.insert(all.end(), others.begin(), others.end());
  return all;
}

using Counts = std::array<Index, 2>;
const std::vector<Counts> kFewCounts = {{3, 3},    {3, 4},    {5, 3},      {4, 17},
                                        {17, 17},  {3, 64},   {64, 17},    {64, 64},
                                        {10, 500}, {500, 64}, {100, 5000}, {5000, 500}};
const std::vector<Counts> kManyCounts = {{64, 64}, {64, 500}, {500, 64}, {500, 500}, {100, 5000}};

std::string name_of(const ::testing::TestParamInfo<std::tuple<Scene, Counts>>& test) {
  const auto& [scene, counts] = test.param;
  return scene.name + "_" + std::to_string(counts[0]) + "_" + std::to_string(counts[1]);
}

class BridgePairs : public ::testing::TestWithParam<std::tuple<Scene, Counts>> {
 protected:
  Scene scene = std::get<0>(GetParam());
  Rim host = scene.make_host(std::get<1>(GetParam())[0], 0.1);
  Rim part = scene.make_part(std::get<1>(GetParam())[1], 0.7);
  Bridge strip = test::bridge(host, part);
  Joined joined = test::join(host, part, strip);
};

TEST_P(BridgePairs, BecomeOneOrientedRing) {
  EXPECT_THAT(manifold_faults(joined.mesh), IsEmpty());
  const CheckReport report = check(joined.mesh);
  EXPECT_EQ(report.statistics.euler_characteristic, 0);
  EXPECT_EQ(report.statistics.boundary_loops, 2U);
  EXPECT_EQ(report.statistics.component_sizes.size(), 1U);
}

TEST_P(BridgePairs, HaveATriangleOnEachEdgeThatRunsItBackwards) {
  if (!strip.welded.empty()) return;  // some edges then need none
  std::set<std::array<Index, 2>> first_sides;
  for (const Triangle& triangle : strip.triangles) first_sides.insert({triangle[0], triangle[1]});
  EXPECT_EQ(first_sides.size(), strip.triangles.size());
  const auto n = static_cast<Index>(host.loop.size());
  const auto m = static_cast<Index>(part.loop.size());
  ASSERT_EQ(strip.triangles.size(), n + m);
  for (Index k = 0; k < n; ++k) EXPECT_TRUE(first_sides.contains({(k + 1) % n, k}));
  for (Index k = 0; k < m; ++k) EXPECT_TRUE(first_sides.contains({n + (k + 1) % m, n + k}));
}

INSTANTIATE_TEST_SUITE_P(All, BridgePairs, Combine(ValuesIn(scenes()), ValuesIn(kFewCounts)),
                         name_of);

using FlatPairs = BridgePairs;

TEST_P(FlatPairs, DoNotFold) {
  for (const Index face : joined.strip_faces) {
    ASSERT_GT(test::area_vector(joined.mesh, face).z(), 0.0) << face;
  }
}

INSTANTIATE_TEST_SUITE_P(All, FlatPairs, Combine(ValuesIn(flat_scenes()), ValuesIn(kManyCounts)),
                         name_of);

class ZipCount : public ::testing::TestWithParam<Index> {};
INSTANTIATE_TEST_SUITE_P(All, ZipCount, ::testing::Values(5, 17, 64, 500, 5000));

TEST_P(ZipCount, CirclesAnEdgeApartGetTrianglesOfGoodShape) {
  const double edge = 2.0 * std::numbers::pi / GetParam();
  for (const double start : {0.0, 0.3, 0.5, 0.9}) {
    const Rim host = hole_in_sheet(GetParam(), circle(1.0));
    const Rim part = upright_part(GetParam(), circle(1.0, 0.87 * edge), start * edge);
    const Joined joined = test::join(host, part, test::bridge(host, part));
    for (const Index face : joined.strip_faces) {
      ASSERT_GT(test::least_angle(joined.mesh, face), 39.0) << start;
    }
  }
}

TEST_P(ZipCount, ALoopPutBackWhereItWasIsWeldedThroughout) {
  const Rim host = hole_in_sheet(GetParam(), saddle(1.0, 0.3));
  for (const double turn : {0.0, 0.4}) {
    Rim part = upright_part(GetParam(), saddle(1.0, 0.3));
    const auto shift = static_cast<std::ptrdiff_t>(turn * GetParam());
    std::rotate(part.loop.begin(), part.loop.begin() + shift, part.loop.end());
    const Bridge strip = test::bridge(host, part);
    EXPECT_THAT(strip.welded, SizeIs(GetParam()));
    EXPECT_THAT(strip.triangles, IsEmpty());
  }
}

TEST(Bridge, FansOfAFineLoopAreSpreadEvenlyOverTheCoarseOne) {
  const Rim host = hole_in_sheet(500, circle(1.0));
  const Rim part = flat_part(10, circle(0.7), 0.01);
  std::map<Index, int> fan;
  for (const Triangle& triangle : test::bridge(host, part).triangles) {
    if (triangle[0] < 500) ++fan[triangle[2]];
  }
  EXPECT_THAT(fan, SizeIs(10));
  for (const auto& [vertex, triangles] : fan) EXPECT_NEAR(triangles, 50, 2) << vertex;
}

TEST(Bridge, LoopsOnOneCurveAreWeldedWhereTheyShareVertices) {
  const Rim host = hole_in_sheet(64, circle(1.0));
  const Rim part = upright_part(32, circle(1.0));
  const Bridge strip = test::bridge(host, part);
  EXPECT_THAT(strip.welded, SizeIs(32));
  EXPECT_THAT(strip.triangles, SizeIs(32));
  EXPECT_THAT(manifold_faults(test::join(host, part, strip).mesh), IsEmpty());
}

TEST(Bridge, LoopsThatTouchInPlacesAreWeldedThere) {
  const Rim host = hole_in_sheet(100, circle(1.0));
  for (const int spikes : {2, 5, 10}) {
    const Rim part = flat_part(50, star(0.6, 1.0, spikes));
    const Bridge strip = test::bridge(host, part);
    EXPECT_THAT(strip.welded, SizeIs(spikes));
    const Joined joined = test::join(host, part, strip);
    EXPECT_THAT(manifold_faults(joined.mesh), IsEmpty());
    for (const Index face : joined.strip_faces) {
      EXPECT_GT(test::area_vector(joined.mesh, face).z(), 0.0) << spikes << " spikes, " << face;
    }
  }
}

TEST(Bridge, APartLargerThanItsHoleIsNotJoinedAcrossTheHole) {
  const Rim host = hole_in_sheet(60, circle(1.0));
  const Rim part = upright_part(90, circle(1.6, 0.3), 0.7);
  const Joined joined = test::join(host, part, test::bridge(host, part));
  for (const Index face : joined.strip_faces) {
    const auto corners = joined.mesh.face(face);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3d& from = joined.mesh.positions[corners[k]];
      EXPECT_LT((joined.mesh.positions[corners[(k + 1) % 3]] - from).norm(), 0.8) << face;
    }
  }
}

TEST(Bridge, NothingIsWeldedWhereNothingIsNear) {
  EXPECT_THAT(test::bridge(hole_in_sheet(64, circle(1.0)), flat_part(64, circle(0.99))).welded,
              IsEmpty());
}

// The strip in terms that do not depend on where the loops start.
std::set<Triangle> unturned(const Bridge& strip, Index n, Index host_turn, Index m,
                            Index part_turn) {
  std::set<Triangle> triangles;
  for (Triangle triangle : strip.triangles) {
    for (Index& v : triangle) v = v < n ? (v + host_turn) % n : n + (v - n + part_turn) % m;
    triangles.insert(triangle);
  }
  return triangles;
}

Rim turned(Rim rim, Index turn) {
  std::rotate(rim.loop.begin(), rim.loop.begin() + turn, rim.loop.end());
  return rim;
}

TEST(Bridge, TheStartsOfTheLoopsDoNotMatter) {
  for (const Counts& counts : {Counts{40, 57}, Counts{600, 500}, Counts{7, 200}}) {
    const auto [n, m] = counts;
    const Rim host = hole_in_sheet(n, test::moved(saddle(1.1, 0.2), aside(0.11, 0.07, 0.0)));
    const Rim part = upright_part(m, star(0.6, 0.8, 3, 0.2), 0.123);
    const auto expected = unturned(test::bridge(host, part), n, 0, m, 0);
    for (const Index turn : {1U, 3U, 6U}) {
      const Bridge strip = test::bridge(turned(host, turn), turned(part, 2 * turn));
      EXPECT_EQ(unturned(strip, n, turn, m, 2 * turn), expected) << n << " " << m << " " << turn;
    }
  }
}

TEST(Bridge, MovingAndScalingBothChangesNothing) {
  const Rim host = hole_in_sheet(40, test::moved(saddle(1.1, 0.2), aside(0.11, 0.07, 0.0)));
  const Rim part = upright_part(57, star(0.6, 0.8, 3, 0.2), 0.123);
  const Bridge expected = test::bridge(host, part);
  for (const double scale : {1e-6, 1.0, 1e6}) {
    const Affine3d motion = aside(3.0, -2.0, 5.0) *
                            AngleAxisd(1.1, Vector3d(1, 2, -1).normalized()) *
                            Eigen::Scaling(scale);
    Rim moved_host = host;
    Rim moved_part = part;
    for (Vector3d& p : moved_host.mesh.positions) p = motion * p;
    for (Vector3d& p : moved_part.mesh.positions) p = motion * p;
    EXPECT_EQ(test::bridge(moved_host, moved_part).triangles, expected.triangles) << scale;
  }
}

TEST(Bridge, HostAndPartCanChangeRoles) {
  const Rim host = hole_in_sheet(40, saddle(1.1, 0.2), 0.3);
  const Rim part = upright_part(57, star(0.6, 0.8, 3, 0.2), 0.123);
  const Bridge other = test::bridge(part, host);
  std::set<Triangle> triangles;
  for (Triangle triangle : other.triangles) {
    for (Index& v : triangle) v = v < 57 ? v + 40 : v - 57;
    triangles.insert(triangle);
  }
  EXPECT_EQ(triangles, unturned(test::bridge(host, part), 40, 0, 57, 0));
}

TEST(Bridge, AnEdgeInsideTheMeshIsNotRepeatedByAWeldedEdgeOfThePart) {
  // The part's edge from 1 to 0 is on the hole's corners 0 and 2.
  BridgeLoop host{{{1, 0, 0}, {0, -1, 0}, {-1, 0, 0}, {0, 1, 0}}};
  const BridgeLoop part{{{0.2, 0.2, 0.1}, {-1, 0, 0}, {1, 0, 0}}};
  EXPECT_THAT(bridge_loops(host, part, "zip").welded, SizeIs(2));
  host.chords = {{0, 2}};
  EXPECT_THAT(bridge_loops(host, part, "zip").welded, SizeIs(1));
}

TEST(Bridge, AnEdgeInsideTheMeshIsNotRepeatedByATriangleOfTheStrip) {
  // Welded at the hole's corner 0; the notch 0, 1, 2 is best closed from 0 to 2.
  BridgeLoop host{{{1, 0, 0}, {0, -2, 0}, {-1, 0, 0}, {0, 1.5, 0}}};
  const BridgeLoop part{{{1, 0, 0}, {0.3, 0.95, 0}, {-0.5, 0.5, 0}}};
  const auto has_notch = [](const Bridge& strip) {
    return std::ranges::find(strip.triangles, Triangle{2, 1, 0}) != strip.triangles.end();
  };
  const Bridge free = bridge_loops(host, part, "zip");
  host.chords = {{0, 2}};
  const Bridge bound = bridge_loops(host, part, "zip");
  EXPECT_THAT(free.welded, SizeIs(1));
  EXPECT_THAT(bound.welded, SizeIs(1));
  EXPECT_TRUE(has_notch(free));
  EXPECT_FALSE(has_notch(bound));
  EXPECT_EQ(bound.triangles.size(), free.triangles.size());
}

TEST(Bridge, ChordsAreEdgesBetweenVerticesOfTheLoop) {
  const Mesh mesh = grid(1, 2);
  const Topology& topology = mesh.topology();
  const BridgeLoop loop = lapwing::bridge_loop(topology.triangles, mesh.positions,
                                               boundary_loops(topology.triangles, "sheet").at(0));
  EXPECT_THAT(loop.points, SizeIs(6));
  EXPECT_THAT(loop.chords, SizeIs(3));  // two diagonals and the edge between the squares
}

TEST(Bridge, UnusableLoopsAreRefusedByName) {
  const BridgeLoop good{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  const auto message = [&](const BridgeLoop& bad) {
    return error_message<InputError>([&] { bridge_loops(good, bad, "seam"); });
  };
  EXPECT_THAT(message({{{0, 0, 0}, {1, 0, 0}}}), HasSubstr("seam: the part's loop has 2 vertices"));
  EXPECT_THAT(message({{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}}), HasSubstr("zero length"));
  EXPECT_THAT(message({{{0, 0, 0}, {1e80, 0, 0}, {0, 1e80, 0}}}), HasSubstr("too large"));
  EXPECT_THAT(message({{{0, 0, 0}, {NAN, 0, 0}, {0, 1, 0}}}),
              AllOf(HasSubstr("non-finite"), HasSubstr("at index 1")));
  EXPECT_THAT(message({good.points, {{0, 0, 0}}}), HasSubstr("1 opposite corners for 3 edges"));
  EXPECT_THAT(message({good.points, {}, {{0, 7}}}), HasSubstr("from index 0 to 7"));
}

}  // namespace
}  // namespace lapwing
