#pragma once

#include <cmath>
#include <numeric>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/mesh/shapes.h"
#include "lapwing/parameterize/domain_map.h"
#include "lapwing/region/region_spec.h"

namespace lapwing::test {

/// A patch and the positions of its own vertices.
struct PlacedPatch {
  Patch patch;
  std::vector<Eigen::Vector3d> positions;

  DomainMap map(Domain domain) const {
    return mean_value_map(patch, positions, domain, default_pins(patch, positions, domain));
  }
};

inline PlacedPatch placed(const Mesh& mesh, const RegionSpec& region = {AllVertices{}, "region"}) {
  const Topology& topology = mesh.topology();
  PlacedPatch result;
  result.patch = disk_patch(resolve(region, mesh), topology, mesh.positions, "region");
  result.positions = on_patch(result.patch, std::span<const Eigen::Vector3d>(mesh.positions));
  return result;
}

/// A hilly sheet without symmetry, over [0, 3] x [0, 2].
inline Mesh hills(Index columns = 18, Index rows = 12) {
  Mesh mesh = grid(columns, rows);
  for (Eigen::Vector3d& p : mesh.positions) {
    p = {3.0 * p.x(), 2.0 * p.y() + 0.2 * p.x() * p.x(), 0.0};
    p.z() = 0.5 * std::sin(2.0 * p.x() + 0.3) * std::cos(3.0 * p.y()) + 0.2 * p.x() * p.y();
  }
  return mesh;
}

/// The mesh turned, scaled and moved.
inline Mesh moved(Mesh mesh) {
  const Eigen::Affine3d motion = Eigen::Translation3d(40, -70, 9) *
                                 Eigen::AngleAxisd(2.2, Eigen::Vector3d(1, -2, 0.4).normalized()) *
                                 Eigen::Scaling(0.03);
  for (Eigen::Vector3d& p : mesh.positions) p = motion * p;
  return mesh;
}

}  // namespace lapwing::test
