#pragma once

#include <vector>

#include <Eigen/Core>

#include "kernels/awkward_meshes.h"
#include "lapwing/mesh/surface_point.h"

namespace lapwing::test {

/// A region and where its vertices lie on a source.
struct MappedSample {
  MappedRings rings() const { return {target, points}; }
  /// `values`, one per vertex of the mesh, by the region's own numbers.
  std::vector<Eigen::Vector3d> own(std::span<const Eigen::Vector3d> values) const;

  RegionRings target;
  std::vector<SurfacePoint> points;
};

/// Every vertex is a row and lies where it is.
MappedSample identity_map(const Sample& sample);

/// Fifteen of sixteen vertices are rows, in a seeded order; each vertex lies somewhere in a
/// triangle around it, if it has any, and one in `every_nowhere` nowhere (0: none). Weights of
/// points are multiples of 2^-40, so that they sum to 1 exactly.
MappedSample shaken_map(const Sample& sample, unsigned seed, unsigned every_nowhere);

/// One row with `mapped.size()` neighbours: mapped[k] is where neighbour k lies on a source whose
/// vertex 0 is under the row and whose vertices 1, 2, ... are under the neighbours.
MappedSample one_ring(const std::vector<bool>& mapped);

}  // namespace lapwing::test
