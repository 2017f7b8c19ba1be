#include "lapwing/parameterize/warp.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <random>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "parameterize/planar_domains.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

using Eigen::Vector2d;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

WarpResult warp(const PlanarDomain& domain, const std::vector<PointPull>& pulls) {
  return warp_domain(domain.triangles, domain.boundary, domain.points, pulls);
}

bool same_bits(const Vector2d& a, const Vector2d& b) {
  return std::memcmp(a.data(), b.data(), 2 * sizeof(double)) == 0;
}

int turned_over(const PlanarDomain& domain, const std::vector<Vector2d>& points) {
  return static_cast<int>(
      std::count_if(domain.triangles.begin(), domain.triangles.end(), [&](const Triangle& t) {
        const Vector2d e = points[t[1]] - points[t[0]];
        const Vector2d f = points[t[2]] - points[t[0]];
        return !(e.x() * f.y() - e.y() * f.x() > 0.0);
      }));
}

// What holds for every warp.
void expect_sound(const PlanarDomain& domain, const std::vector<PointPull>& pulls,
                  const WarpResult& result) {
  EXPECT_EQ(turned_over(domain, result.points), 0);
  for (const Index v : domain.boundary) {
    EXPECT_TRUE(same_bits(result.points[v], domain.points[v])) << v;
  }
  ASSERT_EQ(result.report.distances.size(), pulls.size());
  for (Index k = 0; k < pulls.size(); ++k) {
    const double distance = (result.points[pulls[k].vertex] - pulls[k].target).norm();
    EXPECT_EQ(result.report.distances[k], distance);
    const auto& unmet = result.report.unmet;
    EXPECT_EQ(std::count(unmet.begin(), unmet.end(), k), distance > 1.8e-6 ? 1 : 0);
  }
}

void expect_all_met(const PlanarDomain& domain, const std::vector<PointPull>& pulls,
                    const WarpResult& result) {
  expect_sound(domain, pulls, result);
  EXPECT_THAT(result.report.unmet, IsEmpty());
  for (const double distance : result.report.distances) EXPECT_LT(distance, 1e-9);
}

// `count` vertices next to the circle of that radius, turned about the centre.
std::vector<PointPull> turned_ring(const PlanarDomain& disk, double radius, int count,
                                   double degrees) {
  std::vector<PointPull> pulls;
  const double turn = degrees * std::numbers::pi / 180.0;
  for (int k = 0; k < count; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / count;
    const Index v = nearest_vertex(disk, radius * Vector2d(std::cos(angle), std::sin(angle)));
    const Vector2d p = disk.points[v];
    pulls.push_back({v,
                     {std::cos(turn) * p.x() - std::sin(turn) * p.y(),
                      std::sin(turn) * p.x() + std::cos(turn) * p.y()}});
  }
  return pulls;
}

// Distinct vertices within 0.8 of the centre, each to somewhere within `reach` of it in both axes.
std::vector<PointPull> random_pulls(const PlanarDomain& disk, int count, double reach,
                                    unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<std::size_t> choice(0, disk.points.size() - 1);
  std::uniform_real_distribution<double> shift(-reach, reach);
  std::set<Index> taken;
  std::vector<PointPull> pulls;
  while (static_cast<int>(pulls.size()) < count) {
    const auto v = static_cast<Index>(choice(random));
    const double dx = shift(random);
    const double dy = shift(random);
    const Vector2d target = disk.points[v] + Vector2d(dx, dy);
    if (disk.points[v].norm() > 0.8 || target.norm() > 0.9 || !taken.insert(v).second) continue;
    pulls.push_back({v, target});
  }
  return pulls;
}

TEST(Warp, WithoutPullsChangesNoBit) {
  const PlanarDomain disk = disk_of_rings(5);
  const WarpResult result = warp(disk, {});
  for (std::size_t v = 0; v < disk.points.size(); ++v) {
    EXPECT_TRUE(same_bits(result.points[v], disk.points[v]));
  }
  EXPECT_EQ(result.report.steps, 0);
}

TEST(Warp, PullsToWhereTheVerticesAreChangeNoBit) {
  const PlanarDomain square = square_grid(8);
  const WarpResult result = warp(square, {{40, square.points[40]}, {22, square.points[22]}});
  for (std::size_t v = 0; v < square.points.size(); ++v) {
    EXPECT_TRUE(same_bits(result.points[v], square.points[v]));
  }
  EXPECT_THAT(result.report.distances, ElementsAre(0.0, 0.0));
}

TEST(Warp, OnePullIsMetInOneStep) {
  for (const PlanarDomain& domain : {disk_of_rings(12), square_grid(24)}) {
    const Vector2d middle = domain.points[domain.boundary[0]] * 0.4 + Vector2d(0.3, 0.3);
    const Index v = nearest_vertex(domain, middle);
    const std::vector<PointPull> pulls{{v, domain.points[v] + Vector2d(-0.05, 0.03)}};
    const WarpResult result = warp(domain, pulls);
    expect_all_met(domain, pulls, result);
    EXPECT_EQ(result.report.steps, 1);
    EXPECT_EQ(result.report.constrained_steps, 0);
  }
}

TEST(Warp, PinsStayWhereTheyAreWhileAnotherVertexMoves) {
  const PlanarDomain disk = disk_of_rings(12);
  const Index pin = nearest_vertex(disk, {0.1, 0.3});
  const std::vector<PointPull> pulls{{pin, disk.points[pin]}, {0, {0.2, 0.1}}};
  const WarpResult result = warp(disk, pulls);
  expect_all_met(disk, pulls, result);
  EXPECT_TRUE(same_bits(result.points[pin], disk.points[pin]));
}

TEST(Warp, PullsAcrossAThirdOfTheDomainAreMetInSteps) {
  for (const PlanarDomain& domain : {disk_of_rings(16), square_grid(24)}) {
    const double size = domain.points[domain.boundary[0]].norm() > 0.5 ? 2.0 : 1.0;
    const Vector2d start = size == 2.0 ? Vector2d(-0.3, 0.1) : Vector2d(0.3, 0.5);
    const Index v = nearest_vertex(domain, start);
    const std::vector<PointPull> pulls{{v, domain.points[v] + Vector2d(size / 3.0, size / 20.0)}};
    const WarpResult result = warp(domain, pulls);
    expect_all_met(domain, pulls, result);
    EXPECT_GT(result.report.steps, 1);
    EXPECT_EQ(result.report.constrained_steps, 0);
  }
}

TEST(Warp, ManyModeratePullsAreMet) {
  const PlanarDomain disk = disk_of_rings(24);
  for (unsigned seed = 1; seed <= 12; ++seed) {
    const std::vector<PointPull> pulls = random_pulls(disk, 15, 0.06, seed);
    expect_all_met(disk, pulls, warp(disk, pulls));
  }
}

TEST(Warp, StaysBijectiveWhateverIsPulled) {
  const PlanarDomain disk = disk_of_rings(8);
  for (unsigned seed = 1; seed <= 12; ++seed) {
    const std::vector<PointPull> pulls = random_pulls(disk, 12, 0.6, seed);
    expect_sound(disk, pulls, warp(disk, pulls));
  }
}

TEST(Warp, TurnsAnInnerRing) {
  const PlanarDomain disk = disk_of_rings(20);
  for (const double degrees : {90.0, 170.0, -170.0}) {
    const std::vector<PointPull> pulls = turned_ring(disk, 0.4, 8, degrees);
    expect_all_met(disk, pulls, warp(disk, pulls));
  }
}

TEST(Warp, CoarseRingIsTurnedByTheConstrainedParameterization) {
  const PlanarDomain disk = disk_of_rings(10);
  const std::vector<PointPull> pulls = turned_ring(disk, 0.5, 6, 170.0);
  const WarpResult result = warp(disk, pulls);
  expect_all_met(disk, pulls, result);
  EXPECT_GT(result.report.constrained_steps, 0);
}

TEST(Warp, NeighboursChangePlaces) {
  const PlanarDomain disk = disk_of_rings(20);
  const Index a = nearest_vertex(disk, {0.1, 0.0});
  const Index b = nearest_vertex(disk, {0.15, 0.0});
  const std::vector<PointPull> pulls{{a, disk.points[b]}, {b, disk.points[a]}};
  expect_all_met(disk, pulls, warp(disk, pulls));
}

TEST(Warp, PullsToOnePlaceAreNamedAndTheOthersMet) {
  const PlanarDomain disk = disk_of_rings(12);
  const std::vector<PointPull> pulls{{nearest_vertex(disk, {0.3, 0.0}), {0.0, 0.1}},
                                     {nearest_vertex(disk, {0.0, -0.5}), {0.1, -0.4}},
                                     {nearest_vertex(disk, {-0.3, 0.0}), {0.0, 0.1}}};
  const WarpResult result = warp(disk, pulls);
  expect_sound(disk, pulls, result);
  EXPECT_THAT(result.report.unmet, ElementsAre(0, 2));
  EXPECT_LT(result.report.distances[1], 1e-9);
}

TEST(Warp, PullsThatTurnATriangleOverAreNamedAndTheOthersMet) {
  const PlanarDomain disk = disk_of_rings(12);
  const Triangle corners = disk.triangles[10];
  const std::vector<PointPull> pulls{{nearest_vertex(disk, {0.6, 0.5}), {0.5, 0.5}},
                                     {corners[0], disk.points[corners[1]]},
                                     {corners[1], disk.points[corners[0]]},
                                     {corners[2], disk.points[corners[2]]}};
  const WarpResult result = warp(disk, pulls);
  expect_sound(disk, pulls, result);
  EXPECT_THAT(result.report.unmet, testing::IsSubsetOf({1, 2, 3}));
  EXPECT_THAT(result.report.unmet, testing::Not(IsEmpty()));
}

// A vertex cannot leave the ring of its neighbours when these are pinned, all but one.
TEST(Warp, OnePullIsGivenUpWhereTheOthersLockItIn) {
  const PlanarDomain disk = disk_of_rings(6);
  std::vector<PointPull> pulls{{0, {0.5, 0.3}}};
  for (Index v = 2; v <= 6; ++v) pulls.push_back({v, disk.points[v]});
  const WarpResult result = warp(disk, pulls);
  expect_sound(disk, pulls, result);
  EXPECT_EQ(result.report.unmet.size(), 1U);
}

TEST(Warp, VeryUnevenTrianglesStayUpright) {
  const PlanarDomain disk =
      disk_of_rings(20, [](double share) { return std::pow(10.0, 8.0 * (share - 1.0)); });
  const std::vector<PointPull> far{{0, {0.4, 0.3}}, {nearest_vertex(disk, {0.3, 0.0}), {0.5, 0.4}}};
  expect_all_met(disk, far, warp(disk, far));
  const std::vector<PointPull> turn = turned_ring(disk, 0.4, 6, 90.0);
  expect_sound(disk, turn, warp(disk, turn));
  const std::vector<PointPull> tear{{0, {0.3, 0.0}}, {1, {-0.3, 0.0}}};
  expect_sound(disk, tear, warp(disk, tear));
}

TEST(Warp, MirroredPullsGiveAMirroredResult) {
  const PlanarDomain square = square_grid(20);
  std::vector<PointPull> pulls;
  for (const auto& [from, to] : {std::pair(Vector2d(0.3, 0.4), Vector2d(0.45, 0.7)),
                                 std::pair(Vector2d(0.8, 0.2), Vector2d(0.6, 0.3))}) {
    pulls.push_back({nearest_vertex(square, from), to});
    pulls.push_back({nearest_vertex(square, {from.y(), from.x()}), {to.y(), to.x()}});
  }
  const WarpResult result = warp(square, pulls);
  expect_all_met(square, pulls, result);
  for (Index r = 0; r <= 20; ++r) {
    for (Index c = 0; c <= 20; ++c) {
      const Vector2d& p = result.points[r * 21 + c];
      const Vector2d& q = result.points[c * 21 + r];
      EXPECT_LT((p - Vector2d(q.y(), q.x())).norm(), 1e-10);
    }
  }
}

TEST(Warp, IsTheSameInATurnedAndScaledDisk) {
  const PlanarDomain disk = disk_of_rings(12);
  const auto carried = [](const Vector2d& p) {
    return Vector2d(7.0 * (0.6 * p.x() - 0.8 * p.y()) + 2.0, 7.0 * (0.8 * p.x() + 0.6 * p.y()));
  };
  PlanarDomain other = disk;
  for (Vector2d& p : other.points) p = carried(p);
  const std::vector<PointPull> pulls = random_pulls(disk, 6, 0.15, 5);
  std::vector<PointPull> other_pulls = pulls;
  for (PointPull& pull : other_pulls) pull.target = carried(pull.target);
  const WarpResult result = warp(disk, pulls);
  const WarpResult other_result = warp(other, other_pulls);
  ASSERT_EQ(result.report.steps, other_result.report.steps);
  for (std::size_t v = 0; v < disk.points.size(); ++v) {
    EXPECT_LT((other_result.points[v] - carried(result.points[v])).norm(), 1e-9);
  }
}

TEST(Warp, GivesTheSameBitsAgain) {
  const PlanarDomain disk = disk_of_rings(10);
  const std::vector<PointPull> pulls = turned_ring(disk, 0.5, 6, 170.0);
  const WarpResult first = warp(disk, pulls);
  const WarpResult second = warp(disk, pulls);
  for (std::size_t v = 0; v < disk.points.size(); ++v) {
    ASSERT_TRUE(same_bits(first.points[v], second.points[v]));
  }
}

TEST(Warp, RefusesPullsThatItCannotTake) {
  PlanarDomain disk = disk_of_rings(3);
  const auto refusal = [&](const std::vector<PointPull>& pulls) {
    return error_message<InputError>([&] { warp(disk, pulls); });
  };
  EXPECT_THAT(refusal({{99, {0.0, 0.0}}}),
              HasSubstr("pull 0 of vertex 99: the vertex does not exist"));
  EXPECT_THAT(refusal({{0, {0.1, 0.0}}, {disk.boundary[1], {0.0, 0.0}}}),
              HasSubstr("pull 1 of vertex 20: the vertex is on the boundary"));
  EXPECT_THAT(refusal({{3, {0.1, 0.0}}, {3, {0.0, 0.0}}}),
              HasSubstr("pull 1 of vertex 3: the vertex is already pulled"));
  EXPECT_THAT(refusal({{3, {1.5, 0.0}}}), HasSubstr("(1.5, 0) is not inside"));
  EXPECT_THAT(refusal({{3, disk.points[disk.boundary[0]]}}), HasSubstr("is not inside"));
  EXPECT_THAT(refusal({{3, {std::numeric_limits<double>::quiet_NaN(), 0.0}}}),
              HasSubstr("is not inside"));
  disk.points.emplace_back(0.2, 0.2);
  EXPECT_THAT(refusal({{37, {0.1, 0.0}}}), HasSubstr("belongs to no triangle"));
  std::swap(disk.triangles[5][0], disk.triangles[5][1]);
  EXPECT_THAT(refusal({}), HasSubstr("triangle 5 "));
}

}  // namespace
}  // namespace lapwing
