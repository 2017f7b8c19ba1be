#include "lapwing/wrap/alignment.h"

#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/mesh/shapes.h"
#include "wrap/known_scan.h"

namespace lapwing {
namespace {

using Eigen::Affine3d;
using Eigen::Vector3d;

const Affine3d kAway(Eigen::Translation3d(7.0, -3.0, 2.0) *
                     Eigen::AngleAxisd(2.4, Vector3d(1, -2, 0.5).normalized()) *
                     Eigen::Scaling(3.0));

// A surface without symmetry.
Mesh lump() {
  Mesh mesh = icosphere(3);
  for (Vector3d& p : mesh.positions) {
    p = p.cwiseProduct(Vector3d(1.0, 1.6, 2.4));
    if (p.z() > 0.0) p.x() += 0.3 * p.z();
    if (p.y() > 0.5) p.z() += 0.8 * (p.y() - 0.5);
  }
  return mesh;
}

Positions mapped(const Affine3d& map, Positions positions) {
  for (Vector3d& p : positions) p = map * p;
  return positions;
}

TEST(AlignPoints, FindsTheSimilarityOfThreePoints) {
  const Positions from{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}};
  const Alignment alignment = align_points(from, mapped(kAway, from));
  EXPECT_TRUE(alignment.map.isApprox(kAway, 1e-9));
  EXPECT_NEAR(alignment.scale, 3.0, 1e-9);
}

TEST(AlignPoints, NeverReflects) {
  const Positions from{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  Positions to = from;
  for (Vector3d& p : to) p.x() = -p.x();
  EXPECT_GT(align_points(from, to).map.linear().determinant(), 0.0);
}

TEST(AlignPoints, RefusesPointsOnALine) {
  const Positions line{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {5, 5, 5}};
  const Positions others{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}};
  EXPECT_THROW(align_points(line, others), InputError);
  EXPECT_THROW(align_points(others, line), InputError);
  EXPECT_THROW(align_points({others.data(), 2}, {others.data(), 2}), InputError);
}

TEST(AlignSurfaces, FindsAMovedRotatedAndScaledCopy) {
  const Mesh mesh = lump();
  const Positions moved = mapped(kAway, mesh.positions);
  const ScanSurface surface(mesh.topology(), mesh.positions);
  const ScanSurface scan(mesh.topology(), moved);
  const Alignment alignment = align_surfaces(surface, scan);
  EXPECT_NEAR(alignment.scale, 3.0, 0.1);
  EXPECT_LT(test::mean_error(mapped(alignment.map, mesh.positions), moved), 0.03);
  EXPECT_LT(alignment.mean_distance, 0.01);
}

TEST(AlignSurfaces, FindsASurfaceThatIsStretchedAsWell) {
  const Mesh mesh = lump();
  const Affine3d stretched = kAway * Eigen::Scaling(1.15, 0.9, 1.0);
  const Positions moved = mapped(stretched, mesh.positions);
  const Alignment alignment = align_surfaces(ScanSurface(mesh.topology(), mesh.positions),
                                             ScanSurface(mesh.topology(), moved));
  EXPECT_LT(test::mean_error(mapped(alignment.start, mesh.positions), moved), 0.03);
}

}  // namespace
}  // namespace lapwing
