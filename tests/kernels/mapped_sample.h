#pragma once

#include <vector>

#include <Eigen/Core>

#include "kernels/awkward_meshes.h"
#include "lapwing/mesh/closest_point.h"

namespace lapwing::test {

/// A region, and the points on a source surface to which its vertices are mapped.
struct MappedSample {
  MappedRings rings() const { return {target, points}; }
  /// `values` has one element per vertex of the mesh. Returns those of the region's vertices, in
  /// the order of the region.
  std::vector<Eigen::Vector3d> own(std::span<const Eigen::Vector3d> values) const;

  RegionRings target;
  std::vector<SurfacePoint> points;
};

/// Returns a region in which every vertex is a row and is mapped to itself.
MappedSample identity_map(const Sample& sample);

/// Returns a region in which 15 of 16 vertices are rows, in a random order. Each vertex is mapped
/// to a random point in an adjacent triangle. If `every_nowhere` is not 0, one in `every_nowhere`
/// vertices is not mapped. The weights of points are multiples of 2^-40, so that they sum to
/// exactly 1.
MappedSample shaken_map(const Sample& sample, unsigned seed, unsigned every_nowhere);

/// Returns one row with `mapped.size()` neighbours. The row is mapped to vertex 0 of the source. If
/// mapped[k] is true, neighbour k is mapped to vertex k + 1; otherwise it is not mapped.
MappedSample one_ring(const std::vector<bool>& mapped);

}  // namespace lapwing::test
