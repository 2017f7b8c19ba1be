#include "lapwing/transplant/collar.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/region/geodesic.h"
#include "support/error_message.h"
#include "transplant/pierced.h"

namespace lapwing {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

struct Piece {
  Mesh mesh;
  Topology topology;
  BoundaryLoop seam;
  std::vector<double> distances;
};

Piece piece(Mesh mesh) {
  Piece result{std::move(mesh), {}, {}, {}};
  result.topology = result.mesh.topology();
  result.seam = boundary_loops(result.topology.triangles, "piece").front();
  result.distances = geodesic_distances(result.topology, result.mesh.positions, result.seam);
  return result;
}

Collar collar_of(const Piece& piece, double width) {
  return make_collar(piece.topology.triangles, piece.seam, piece.distances, width, "test");
}

TEST(Collar, IsAnAnnulusBetweenItsLoops) {
  const Piece square = piece(grid(20, 20));
  for (const double width : {1e-6, 0.1, 0.2, 0.35}) {
    const Collar collar = collar_of(square, width);
    const auto loops = boundary_loops(collar.triangles, "collar");
    ASSERT_EQ(loops.size(), 2U) << width;
    EXPECT_EQ(collar.seam, square.seam);
    EXPECT_THAT(loops, ::testing::Contains(collar.inner));
    // Every vertex nearer than the width is inside, with all of its triangles.
    for (const Index v : collar.inner) EXPECT_GE(square.distances[v], width);
  }
}

TEST(Collar, FillsWhatTheOffsetWouldCutOff) {
  // A hill within the width: its top is farther from the seam than the width along the surface.
  Mesh hill = grid(60, 60);
  for (Eigen::Vector3d& p : hill.positions) {
    const double r = (p.head<2>() - Eigen::Vector2d(0.12, 0.5)).norm();
    p.z() = r < 0.08 ? 0.3 * (1.0 - r / 0.08) : 0.0;
  }
  const Piece square = piece(hill);
  const Collar collar = collar_of(square, 0.25);
  EXPECT_EQ(boundary_loops(collar.triangles, "collar").size(), 2U);
}

TEST(Collar, IsEmptyWhereNothingIsLeftBeyond) {
  EXPECT_THAT(collar_of(piece(grid(20, 20)), 0.6).triangles, IsEmpty());
}

TEST(Collar, NamesAnotherBoundaryWithinItsWidth) {
  const Piece pierced = piece(test::with_hole(grid(40, 40), {0.2, 0.5, 0.0}, 0.05));
  EXPECT_THAT(error_message<InputError>([&] { collar_of(pierced, 0.3); }),
              HasSubstr("another boundary"));
  EXPECT_EQ(boundary_loops(collar_of(pierced, 0.1).triangles, "collar").size(), 2U);
}

}  // namespace
}  // namespace lapwing
