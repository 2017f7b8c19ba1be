#include "studies/ends_motion.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/mesh/shapes.h"

namespace lapwing::bench {
namespace {

using Eigen::Vector3d;
using ::testing::ElementsAre;

// 5 x 8 vertices, longest along y; row r holds vertices 5 r to 5 r + 4.
Positions long_grid() {
  Positions positions = grid(4, 7).positions;
  for (Vector3d& p : positions) p.y() *= 3.0;
  return positions;
}

TEST(EndsMotion, LiftMovesATenthAsideAlongTheAxisAfterTheLongest) {
  const Positions positions = long_grid();
  const MovedEnds ends = moved_ends(EndsMotion::lift, positions);
  EXPECT_THAT(ends.belt, ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(ends.handle, ElementsAre(36, 37, 38, 39));
  EXPECT_TRUE(ends.map.linear().isIdentity());
  EXPECT_TRUE(ends.map.translation().isApprox(0.1 * std::sqrt(10.0) * Vector3d::UnitZ()));
}

TEST(EndsMotion, LiftGoesRoundFromZToX) {
  Positions positions = long_grid();
  for (Vector3d& p : positions) std::swap(p.y(), p.z());
  const MovedEnds ends = moved_ends(EndsMotion::lift, positions);
  EXPECT_TRUE(ends.map.translation().isApprox(0.1 * std::sqrt(10.0) * Vector3d::UnitX()));
}

TEST(EndsMotion, LeanTurnsTheTopAroundItsMeanAndMovesItInX) {
  const Positions positions = long_grid();
  const MovedEnds ends = moved_ends(EndsMotion::lean, positions);
  EXPECT_THAT(ends.belt, ElementsAre(0, 1, 2));
  EXPECT_THAT(ends.handle, ElementsAre(37, 38, 39));
  const Vector3d mean = positions[38];
  const Vector3d moved = mean + 0.2 * std::sqrt(10.0) * Vector3d::UnitX();
  EXPECT_TRUE((ends.map * mean).isApprox(moved));
  // Clockwise as seen from +z.
  const Vector3d right = positions[39] - mean;
  const Vector3d turned(std::sqrt(0.75) * right.norm(), -0.5 * right.norm(), 0.0);
  EXPECT_TRUE((ends.map * positions[39]).isApprox(moved + turned));
}

TEST(EndsMotion, HoldsThreeVerticesAtLeast) {
  const Positions positions = grid(3, 2).positions;
  EXPECT_EQ(moved_ends(EndsMotion::lean, positions).belt.size(), 3u);
  EXPECT_EQ(moved_ends(EndsMotion::lift, positions).handle.size(), 3u);
}

TEST(EndsMotion, RefusesWhatHasNoEnds) {
  Positions positions = grid(3, 2).positions;
  EXPECT_THROW(moved_ends(EndsMotion::lift, std::span(positions).first(5)), InputError);
  positions[4].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(moved_ends(EndsMotion::lift, positions), InputError);
}

// 4 x 4 vertices.
constexpr Index kGridVertices = 16;

// Appends the grid again, so far aside, in vertices of its own.
void add_grid(Mesh& mesh, const Vector3d& aside) {
  const Mesh more = grid(3, 3);
  const auto first = static_cast<Index>(mesh.vertex_count());
  for (const Vector3d& p : more.positions) mesh.positions.push_back(p + aside);
  for (std::size_t f = 0; f < more.face_count(); ++f) {
    std::vector<Index> corners(more.face(f).begin(), more.face(f).end());
    for (Index& v : corners) v += first;
    mesh.add_face(corners);
  }
}

MovedEnds ends_of(VertexSet belt, VertexSet handle) {
  return {std::move(belt), std::move(handle), Eigen::Affine3d::Identity()};
}

TEST(HeldRegion, IsTheWholeMeshWhereItIsOnePiece) {
  const Mesh mesh = grid(3, 3);
  const HeldRegion held =
      held_region(ends_of({0, 1, 4}, {14, 15}), mesh.positions, mesh.topology());
  EXPECT_EQ(held.region.roi.size(), kGridVertices);
  EXPECT_EQ(held.region.belt, VertexSet({0, 1, 4}));
  EXPECT_EQ(held.region.handles, std::vector<VertexSet>({{14, 15}}));
  EXPECT_EQ(held.left_out, 0u);
}

TEST(HeldRegion, LeavesOutPiecesThatNothingHoldsAndLooseVertices) {
  Mesh mesh = grid(3, 3);
  add_grid(mesh, Vector3d(2.0, 0.0, 0.0));
  mesh.positions.emplace_back(0.0, -1.0, 0.0);
  const Index loose = 2 * kGridVertices;
  const Topology& topology = mesh.topology();
  const HeldRegion held =
      held_region(ends_of({0, 1, 4, loose}, {14, 15}), mesh.positions, topology);
  EXPECT_EQ(held.region.roi.size(), kGridVertices);
  EXPECT_EQ(held.region.belt, VertexSet({0, 1, 4}));
  EXPECT_EQ(held.left_out, kGridVertices + 1);
  EXPECT_NO_THROW(check_anchors(held.region, mesh.positions, topology, "region"));
}

TEST(HeldRegion, LeavesOutPiecesThatAreHeldInOneLineOnly) {
  Mesh mesh = grid(3, 3);
  add_grid(mesh, Vector3d(2.0, 0.0, 0.0));
  const VertexSet line{kGridVertices, kGridVertices + 1, kGridVertices + 2};
  const HeldRegion held =
      held_region(ends_of(unite({0, 1, 4}, line), {14, 15}), mesh.positions, mesh.topology());
  EXPECT_EQ(held.region.belt, VertexSet({0, 1, 4}));
  EXPECT_EQ(held.left_out, kGridVertices);
}

TEST(HeldRegion, RefusesWhereAnEndHoldsNothing) {
  Mesh mesh = grid(3, 3);
  mesh.positions.emplace_back(0.0, -1.0, 0.0);
  const Topology& topology = mesh.topology();
  EXPECT_THROW(held_region(ends_of({0, 1, 4}, {kGridVertices}), mesh.positions, topology),
               InputError);
  EXPECT_THROW(held_region(ends_of({kGridVertices}, {0, 1, 4}), mesh.positions, topology),
               InputError);
}

}  // namespace
}  // namespace lapwing::bench
