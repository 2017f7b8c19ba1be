#pragma once

#include <memory>
#include <span>
#include <utility>

#include "lapwing/laplacian/rsi_system.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/region/vertex_set.h"

namespace lapwing {

class FactorCache;

/// 0 and -0 are not the same rest shape.
bool same_bits(std::span<const Eigen::Vector3d> a, std::span<const Eigen::Vector3d> b);

/// What the preparation of an edit leaves for the next one on the same ROI, so that another handle,
/// belt, constraint weight, Laplacian weights or settle options repeat neither the ordering nor the
/// symbolic factorization:
///
///     PreparedRegion prepared(topology);
///     DeformSolver solver(prepared, mesh.positions, region, options, kernels);
///     region.handles = {another};
///     DeformSolver next(prepared, mesh.positions, region, options, kernels);  // half the time
///
/// It keeps pattern, order and both symbolic factorizations. For the same positions and Laplacian
/// weights it keeps the rows of M and M'M, and if handles, belt and targets are the same as well,
/// the coarse surface of drags. If no solver uses the last factor any more, the next one takes its
/// memory and recomputes only what the change reaches. Results are those of a full preparation bit
/// for bit. An edit with another ROI or other unknowns is prepared in full and replaces what is
/// kept. (With hard constraints only the free vertices are unknowns, and they change with the
/// handle.) A preparation over the same unknowns that is cancelled or fails loses nothing.
///
/// Earlier solvers keep their own factors and are not affected. One preparation at a time.
class PreparedRegion {
 public:
  /// Nothing is kept yet. `topology` must outlive the object and what is prepared with it.
  explicit PreparedRegion(const Topology& topology) : topology_(topology) {}

  const Topology& topology() const { return topology_; }

  /// For EditSystem: whether what is kept serves an edit over `unknowns`.
  bool serves(const VertexSet& roi, const Unknowns& unknowns) const;
  /// For EditSystem: what is kept for them, or a new cache.
  std::shared_ptr<FactorCache> factors_of(const VertexSet& roi, const Unknowns& unknowns);
  /// For EditSystem: a copy of `rest`, the one kept if that is the same bit for bit.
  std::shared_ptr<const Positions> copy_of(std::span<const Eigen::Vector3d> rest);

 private:
  const Topology& topology_;
  std::shared_ptr<FactorCache> factors_;
  std::shared_ptr<const Positions> rest_;
};

}  // namespace lapwing
