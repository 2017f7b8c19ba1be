#include "lapwing/deform/commits.h"

#include <array>

#include <gtest/gtest.h>

#include "support/bent_tube.h"

namespace lapwing {
namespace {

TEST(Commits, StepIsExactOnlyIfEachOfItsPartsIs) {
  const Mesh mesh = test::bumpy_tube();
  const Topology& topology = mesh.topology();
  const EditRegion region = test::foot_and_head(mesh);
  DeformRequest step;
  step.handles = {{RegionSpec{ListedVertices{region.handles[0]}}, SimilarityMove{}}};
  const std::array centroids{Eigen::Vector3d(0.0, 0.0, 3.0)};
  const BoundRequest bound{step, region, topology, centroids};
  std::array<Certificate, 3> parts;
  EXPECT_EQ(certify(bound, mesh.positions, mesh.positions, parts).why_not_exact, "");
  parts[1].why_not_exact = "it does not fit";
  EXPECT_EQ(certify(bound, mesh.positions, mesh.positions, parts).why_not_exact, "it does not fit");
}

}  // namespace
}  // namespace lapwing
