#include "lapwing/doctor/check.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "doctor/broken_meshes.h"
#include "lapwing/mesh/shapes.h"
#include "support/cancel_everywhere.h"

namespace lapwing {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// Expects `mesh` to have this defect, `count` times, listed as `first`.
void expect_defect(const Mesh& mesh, DefectKind kind, std::size_t count,
                   const std::vector<Index>& first) {
  const CheckReport report = check(mesh);
  const Defect* defect = report.find(kind);
  ASSERT_NE(defect, nullptr) << describe(kind).key;
  EXPECT_EQ(defect->count, count);
  EXPECT_EQ(defect->first, first);
}

class CleanShape : public ::testing::TestWithParam<Mesh> {};

TEST_P(CleanShape, HasNoDefects) {
  for (const Defect& defect : check(GetParam()).defects) {
    if (describe(defect.kind).severity == Severity::info) continue;
    ADD_FAILURE() << defect.count << " " << describe(defect.kind).name;
  }
}

INSTANTIATE_TEST_SUITE_P(Check, CleanShape,
                         ::testing::Values(grid(5, 4), icosphere(2), cylinder(9, 5, 1.0, 2.0),
                                           torus(9, 6, 2.0, 0.5)));

TEST(Check, NamesNonFiniteVerticesAsErrors) {
  Mesh mesh = grid(3, 3);
  mesh.positions[2].x() = std::numeric_limits<double>::quiet_NaN();
  mesh.positions[7].z() = std::numeric_limits<double>::infinity();
  expect_defect(mesh, DefectKind::non_finite_vertex, 2, {2, 7});
  EXPECT_EQ(describe(DefectKind::non_finite_vertex).severity, Severity::error);
}

TEST(Check, NamesLooseVertices) {
  Mesh mesh = grid(1, 1);
  mesh.positions.emplace_back(5, 5, 5);
  mesh.positions.emplace_back(6, 5, 5);
  expect_defect(mesh, DefectKind::loose_vertex, 2, {4, 5});
  EXPECT_EQ(check(mesh).find(DefectKind::several_components), nullptr);
}

TEST(Check, NamesFacesThatRepeatAVertex) {
  Mesh mesh = grid(1, 1);
  add_polygon(mesh, {0, 1, 0});
  add_polygon(mesh, {0, 1});
  add_polygon(mesh, {0, 1, 1, 2});
  expect_defect(mesh, DefectKind::degenerate_face, 3, {2, 3, 4});
}

TEST(Check, NamesFacesThatRepeatAnEarlierOneInAnyOrder) {
  Mesh mesh = grid(1, 1);
  const auto [a, b, c] = std::array{mesh.face(1)[0], mesh.face(1)[1], mesh.face(1)[2]};
  add_polygon(mesh, {c, a, b});
  add_polygon(mesh, {b, a, c});
  expect_defect(mesh, DefectKind::repeated_face, 2, {2, 3});
}

TEST(Check, NamesZeroAreaFacesAndTheirCollinearRings) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 2, 3}, {2, 4, 6}};
  add_polygon(mesh, {0, 1, 2});
  expect_defect(mesh, DefectKind::zero_area_face, 1, {0});
  expect_defect(mesh, DefectKind::collinear_ring, 3, {0, 1, 2});
}

TEST(Check, FlatnessDoesNotDependOnSizeOrPlace) {
  Mesh sliver;
  sliver.positions = {{0, 0, 0}, {1, 0, 0}, {0.5, 1e-4, 0}};
  add_polygon(sliver, {0, 1, 2});
  for (const double scale : {1e-9, 1.0, 1e9}) {
    Mesh mesh = sliver;
    for (Eigen::Vector3d& p : mesh.positions) p *= scale;
    EXPECT_THAT(check(mesh).defects, IsEmpty()) << scale;
  }
}

TEST(Check, NamesRingsWhoseVerticesAreAllAtOnePoint) {
  Mesh mesh = grid(1, 1);
  for (int i = 0; i < 3; ++i) mesh.positions.emplace_back(7, 7, 7);
  add_polygon(mesh, {4, 5, 6});
  expect_defect(mesh, DefectKind::point_ring, 3, {4, 5, 6});
  EXPECT_EQ(check(mesh).find(DefectKind::collinear_ring), nullptr);
}

TEST(Check, NamesBothSidesOfAnUnweldedSeamAndItsDuplicates) {
  expect_defect(unwelded_square(), DefectKind::unwelded_seam, 2, {1, 2, 3, 4});
  expect_defect(unwelded_square(), DefectKind::duplicate_vertex, 2, {3, 4});
  expect_defect(unwelded_square(), DefectKind::several_components, 2, {0, 3});
}

TEST(Check, PiecesThatTouchAtOnePointHaveNoSeam) {
  Mesh mesh = bow_tie();
  mesh.positions.push_back(mesh.positions[0]);
  mesh.edit_faces().vertices[3] = 5;
  EXPECT_EQ(check(mesh).find(DefectKind::unwelded_seam), nullptr);
  EXPECT_FALSE(check(mesh).has_problems());
  EXPECT_NE(check(mesh).find(DefectKind::duplicate_vertex), nullptr);
}

TEST(Check, NamesEdgesWithMoreThanTwoFaces) {
  expect_defect(three_winged_edge(), DefectKind::non_manifold_edge, 1, {0, 1});
  EXPECT_EQ(check(three_winged_edge()).find(DefectKind::bow_tie_vertex), nullptr);
}

TEST(Check, NamesBowTieVertices) {
  expect_defect(bow_tie(), DefectKind::bow_tie_vertex, 1, {0});
}

TEST(Check, NamesEdgesOfAFlippedFace) {
  Mesh mesh = icosphere(1);
  std::swap(mesh.edit_faces().vertices[0], mesh.edit_faces().vertices[1]);
  const CheckReport report = check(mesh);
  const Defect* defect = report.find(DefectKind::inconsistent_orientation);
  ASSERT_NE(defect, nullptr);
  EXPECT_EQ(defect->count, 3U);
  for (const Index v : defect->first) EXPECT_THAT(mesh.face(0), ::testing::Contains(v));
}

TEST(Check, MoebiusStripIsOneSidedAndNotFixable) {
  const CheckReport report = check(moebius_strip());
  ASSERT_NE(report.find(DefectKind::one_sided_surface), nullptr);
  EXPECT_EQ(report.find(DefectKind::inconsistent_orientation), nullptr);
  EXPECT_FALSE(report.is_fixable());
  EXPECT_FALSE(report.statistics.genus.has_value());
}

TEST(Check, PointCloudHasNoUsableFace) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}};
  const CheckReport report = check(mesh);
  ASSERT_NE(report.find(DefectKind::no_faces), nullptr);
  EXPECT_TRUE(report.has_problems());
}

TEST(Check, EmptyMeshHasNoUsableFaceAndZeroStatistics) {
  const CheckReport report = check(Mesh{});
  ASSERT_EQ(report.defects.size(), 1U);
  EXPECT_EQ(report.defects[0].kind, DefectKind::no_faces);
  EXPECT_EQ(report.statistics.mean_edge_length, 0.0);
}

TEST(Check, NamesFacesThatCutThroughOthersWhereAsked) {
  Mesh mesh = grid(1, 1);
  for (const double z : {-1.0, 1.0}) mesh.positions.emplace_back(0.6, 0.2, z);
  mesh.positions.emplace_back(0.3, -5, 0);
  add_polygon(mesh, {4, 5, 6});
  CheckReport report = check(mesh);
  EXPECT_EQ(report.find(DefectKind::self_intersection), nullptr);
  add_self_intersections(mesh, report);
  ASSERT_NE(report.find(DefectKind::self_intersection), nullptr);
  EXPECT_THAT(report.find(DefectKind::self_intersection)->first, ElementsAre(0, 2));
}

TEST(Check, NamesHolesButNotTheBorderOfASheet) {
  expect_defect(cylinder(9, 5, 1.0, 2.0), DefectKind::hole, 2, {0, 36});
  const CheckReport sheet = check(grid(3, 3));
  EXPECT_EQ(sheet.find(DefectKind::hole), nullptr);
  ASSERT_EQ(sheet.holes.size(), 1U);
  EXPECT_EQ(sheet.holes[0].rim.size(), 12U);
}

TEST(DefectInfo, EveryKindHasItsOwnKeyAndWords) {
  std::vector<std::string_view> keys;
  for (int k = 0; k < kDefectKindCount; ++k) {
    const DefectInfo& info = describe(static_cast<DefectKind>(k));
    keys.push_back(info.key);
    EXPECT_FALSE(info.name.empty());
    EXPECT_FALSE(info.meaning.empty()) << info.key;
  }
  std::ranges::sort(keys);
  EXPECT_EQ(std::ranges::adjacent_find(keys), keys.end());
}

TEST(Check, ListsAsManyPlacesAsAreAskedFor) {
  Mesh mesh = bow_tie();
  mesh.positions.resize(100, Eigen::Vector3d(9, 9, 9));
  EXPECT_EQ(check(mesh).find(DefectKind::loose_vertex)->first.size(), kMaxListed);
  EXPECT_EQ(check(mesh, 20).find(DefectKind::loose_vertex)->first.size(), 20U);
  EXPECT_EQ(check(mesh, 1000).find(DefectKind::loose_vertex)->first.size(), 95U);
}

TEST(Check, CanBeCancelledEverywhere) {
  const Mesh mesh = icosphere(4);
  EXPECT_GT(test::cancel_everywhere([&](const Progress& progress) {
              const ProgressScope scope(progress);
              CheckReport report = check(mesh);
              add_self_intersections(mesh, report);
              EXPECT_FALSE(report.has_problems());
            }),
            20U);
}

}  // namespace
}  // namespace lapwing
