#include "studies/real/held_region.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/mesh/shapes.h"

namespace lapwing::bench {
namespace {

using Eigen::Vector3d;

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
