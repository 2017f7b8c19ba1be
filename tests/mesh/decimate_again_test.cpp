#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <set>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "lapwing/mesh/decimate.h"
#include "lapwing/mesh/shapes.h"
#include "mesh/decimated_surfaces.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;
using test::characteristic;

// A bumpy sphere decimated to 300 vertices.
class DecimateAgain : public ::testing::Test {
 protected:
  static constexpr std::size_t kCount = 300;

  // 1 above a height, and 0 below.
  std::vector<Index> groups_above(double z) const {
    std::vector<Index> groups;
    for (const Vector3d& p : mesh_.positions) groups.push_back(p.z() > z ? 1 : 0);
    return groups;
  }
  std::optional<Decimated> again(std::span<const Index> groups) const {
    return decimate_again(first_.history, mesh_.positions, mesh_.topology().triangles, groups,
                          kCount);
  }

  const Mesh mesh_ = test::bumpy_sphere();
  const Decimated first_ = decimate(mesh_.positions, mesh_.topology().triangles,
                                    std::vector<Index>(mesh_.vertex_count(), 0), kCount);
};

// Each edge with two triangles, and all of them facing outward.
void expect_is_a_sphere(const Decimated& d, const Positions& positions) {
  std::multiset<std::pair<Index, Index>> sides;
  for (const Triangle& t : d.triangles) {
    for (std::size_t c = 0; c < 3; ++c) sides.emplace(t[c], t[(c + 1) % 3]);
    const auto at = [&](std::size_t c) { return positions[d.kept[t[c]]]; };
    EXPECT_GT((at(1) - at(0)).cross(at(2) - at(0)).dot(at(0)), 0.0);
  }
  for (const auto& [from, to] : sides) {
    EXPECT_EQ(sides.count({from, to}), 1U);
    EXPECT_EQ(sides.count({to, from}), 1U);
  }
  EXPECT_EQ(characteristic(d.triangles), 2);
}

TEST_F(DecimateAgain, SameGroupsGiveTheSameSurface) {
  const auto d = again(std::vector<Index>(mesh_.vertex_count(), 0));
  ASSERT_TRUE(d.has_value());
  EXPECT_EQ(d->kept, first_.kept);
  EXPECT_EQ(d->owners, first_.owners);
  EXPECT_EQ(d->triangles.size(), first_.triangles.size());
  expect_is_a_sphere(*d, mesh_.positions);
}

TEST_F(DecimateAgain, NewBordersHoldAndMostMergesAreThoseOfBefore) {
  const std::vector<Index> groups = groups_above(0.4);
  const auto d = again(groups);
  ASSERT_TRUE(d.has_value());
  EXPECT_EQ(d->kept.size(), kCount);
  EXPECT_TRUE(std::is_sorted(d->kept.begin(), d->kept.end()));
  for (Index v = 0; v < mesh_.vertex_count(); ++v) {
    ASSERT_LT(d->owners[v], d->kept.size());
    EXPECT_EQ(groups[d->kept[d->owners[v]]], groups[v]);
  }
  expect_is_a_sphere(*d, mesh_.positions);
  std::vector<Index> both;
  std::set_intersection(d->kept.begin(), d->kept.end(), first_.kept.begin(), first_.kept.end(),
                        std::back_inserter(both));
  EXPECT_GE(both.size(), kCount / 2);
}

// However often the border moves: each time from the first merges.
TEST_F(DecimateAgain, StaysASphereWhereverTheBorderGoes) {
  for (double z = -0.9; z < 0.95; z += 0.1) {
    SCOPED_TRACE(z);
    const auto d = again(groups_above(z));
    ASSERT_TRUE(d.has_value());
    EXPECT_LE(d->kept.size(), kCount + kCount / 20);
    expect_is_a_sphere(*d, mesh_.positions);
  }
}

TEST_F(DecimateAgain, AVertexThatIsKeptNowStays) {
  std::vector<Index> groups(mesh_.vertex_count(), 0);
  for (const Index v : {7U, 1000U, 2000U}) groups[v] = kKeptGroup;
  const auto d = again(groups);
  ASSERT_TRUE(d.has_value());
  for (const Index v : {7U, 1000U, 2000U}) EXPECT_EQ(d->kept[d->owners[v]], v);
  expect_is_a_sphere(*d, mesh_.positions);
}

TEST_F(DecimateAgain, IsNotThereWhereMostWouldBeLeft) {
  std::vector<Index> groups(mesh_.vertex_count());
  std::iota(groups.begin(), groups.end(), 0);
  EXPECT_FALSE(again(groups).has_value());
}

// A sheet with holes, which neither close nor meet.
TEST(DecimateAgainSheet, BoundariesStay) {
  const Mesh whole = grid(40, 40);
  Mesh sheet;
  sheet.positions = whole.positions;
  for (Vector3d& p : sheet.positions) p.z() = 0.05 * std::sin(9.0 * p.x()) * std::cos(7.0 * p.y());
  for (const Triangle& t : whole.topology().triangles) {
    const bool in_hole = std::ranges::any_of(t, [](Index v) { return v % 333 == 200; });
    if (!in_hole) sheet.add_face(t);
  }
  const std::vector<Triangle>& triangles = sheet.topology().triangles;
  std::vector<Index> groups(sheet.vertex_count(), 0);
  const Decimated first = decimate(sheet.positions, triangles, groups, 300);
  for (Index v = 0; v < sheet.vertex_count(); ++v) groups[v] = sheet.positions[v].x() > 0.3 ? 1 : 0;
  const auto d = decimate_again(first.history, sheet.positions, triangles, groups, 300);
  ASSERT_TRUE(d.has_value());
  EXPECT_EQ(characteristic(d->triangles), characteristic(triangles));
  EXPECT_LT(characteristic(triangles), 0);
}

}  // namespace
}  // namespace lapwing
