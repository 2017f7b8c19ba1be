#pragma once

#include <memory>
#include <span>
#include <utility>

#include "lapwing/laplacian/normal_matrix.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/region/vertex_set.h"

namespace lapwing {

class FactorCache;

/// Compares bit patterns: 0 and -0 differ.
bool same_bits(std::span<const Eigen::Vector3d> a, std::span<const Eigen::Vector3d> b);

/// Keeps the preparation of an edit for the next one on the same ROI:
///
///     PreparedRegion prepared(topology);
///     DeformSolver solver(prepared, mesh.positions, region, options, kernels);
///     region.handles = {another};
///     DeformSolver next(prepared, mesh.positions, region, options, kernels);  // half the time
///
/// Keeps the pattern, orders and symbolic factorizations. For the same positions and weights it
/// also keeps the rows of M and M'M. For the same handles, belt and targets it also keeps the
/// coarse proxy of drags. If no solver uses the last factor any more, the next one reuses its
/// memory and recomputes only the part that changed. All results have the same bits as those of a
/// full preparation.
///
/// An edit with another ROI or other unknowns is prepared in full and replaces the kept data. With
/// hard constraints, another handle means other unknowns. A preparation that is cancelled or fails
/// loses nothing. Earlier solvers do not change. Only one preparation may run at a time.
class PreparedRegion {
 public:
  /// `topology` must outlive the object and everything prepared with it.
  explicit PreparedRegion(const Topology& topology) : topology_(topology) {}

  const Topology& topology() const { return topology_; }

  /// For EditSystem: whether the kept factors serve an edit over `unknowns`.
  bool serves(const VertexSet& roi, const Unknowns& unknowns) const;
  /// For EditSystem: returns the kept factors if they serve, else a new cache.
  std::shared_ptr<FactorCache> factors_of(const VertexSet& roi, const Unknowns& unknowns);
  /// For EditSystem: returns a copy of `rest`, the kept one if it has the same bits.
  std::shared_ptr<const Positions> copy_of(std::span<const Eigen::Vector3d> rest);

 private:
  const Topology& topology_;
  std::shared_ptr<FactorCache> factors_;
  std::shared_ptr<const Positions> rest_;
};

}  // namespace lapwing
