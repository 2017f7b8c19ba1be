#pragma once

#include <memory>
#include <span>
#include <utility>

#include "lapwing/laplacian/normal_matrix.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/region/vertex_set.h"

namespace lapwing {

class FactorCache;

/// Compares bit patterns: 0 and -0 are different.
bool same_bits(std::span<const Eigen::Vector3d> a, std::span<const Eigen::Vector3d> b);

/// Caches the preparation of an edit for the next edit of the same ROI:
///
///     PreparedRegion prepared(topology);
///     DeformSolver solver(prepared, mesh.positions, region, options, kernels);
///     region.handles = {another};
///     DeformSolver next(prepared, mesh.positions, region, options, kernels);  // half the time
///
/// The cache holds the pattern, the orders and the symbolic factorizations. If positions and
/// weights are the same, the rows of M and the matrix M'M are also reused. If handles, belt and
/// targets are the same, the coarse proxy of drags is also reused. If the last factor is no longer
/// used by any solver, the next factorization reuses its memory and recomputes only what has
/// changed. All results are bitwise identical to those of a full preparation.
///
/// An edit with a different ROI or different unknowns is prepared in full and replaces the cached
/// data. With hard constraints, a different handle means different unknowns. If a preparation is
/// cancelled or fails, the cached data remain. Existing solvers do not change. Only one preparation
/// may run at a time.
class PreparedRegion {
 public:
  /// `topology` must outlive the object and everything prepared with it.
  explicit PreparedRegion(const Topology& topology) : topology_(topology) {}

  const Topology& topology() const { return topology_; }

  /// For EditSystem: returns true if the cached factors can be used for an edit over `unknowns`.
  bool serves(const VertexSet& roi, const Unknowns& unknowns) const;
  /// For EditSystem: returns the cached factors if they can be reused, otherwise a new cache.
  std::shared_ptr<FactorCache> factors_of(const VertexSet& roi, const Unknowns& unknowns);
  /// For EditSystem: returns a copy of `rest`. If the cached copy is bitwise identical, returns
  /// that.
  std::shared_ptr<const Positions> copy_of(std::span<const Eigen::Vector3d> rest);

 private:
  const Topology& topology_;
  std::shared_ptr<FactorCache> factors_;
  std::shared_ptr<const Positions> rest_;
};

}  // namespace lapwing
