#pragma once

#include <vector>

#include <Eigen/Core>

#include "kernels/awkward_meshes.h"
#include "lapwing/mesh/closest_point.h"

namespace lapwing::test {

/// A region, and the points on a source to which its vertices are mapped.
struct MappedSample {
  MappedRings rings() const { return {target, points}; }
  /// Returns those of `values`, one per vertex of the mesh, that belong to the region, in its
  /// order.
  std::vector<Eigen::Vector3d> own(std::span<const Eigen::Vector3d> values) const;

  RegionRings target;
  std::vector<SurfacePoint> points;
};

/// Every vertex is a row and is mapped to itself.
MappedSample identity_map(const Sample& sample);

/// Fifteen of sixteen vertices are rows, in a random order. Each vertex is mapped to a random point
/// in a triangle around it, and one in `every_nowhere` nowhere (0: none). Weights of points are
/// multiples of 2^-40, so that they sum to exactly 1.
MappedSample shaken_map(const Sample& sample, unsigned seed, unsigned every_nowhere);

/// One row with `mapped.size()` neighbours. The row is mapped to vertex 0 of the source, and
/// neighbour k to vertex k + 1, or nowhere unless mapped[k].
MappedSample one_ring(const std::vector<bool>& mapped);

}  // namespace lapwing::test
