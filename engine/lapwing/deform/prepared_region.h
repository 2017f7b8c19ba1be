#pragma once

#include <memory>
#include <span>
#include <utility>

#include "lapwing/laplacian/rsi_system.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/region/vertex_set.h"

namespace lapwing {

class RegionSystem;

/// 0 and -0 are not the same rest shape.
bool same_bits(std::span<const Eigen::Vector3d> a, std::span<const Eigen::Vector3d> b);

/// What the preparation of an edit leaves for the next one on the same ROI, so that another handle,
/// belt, constraint weight, Laplacian weights or settle options order and analyze nothing anew:
///
///     PreparedRegion prepared(topology);
///     Deformer deformer(prepared, mesh.positions, region, options, kernels);
///     region.handles = {another};
///     Deformer next(prepared, mesh.positions, region, options, kernels);  // half the time
///
/// Kept are the pattern, the order, both symbolic factorizations and their memory; with the same
/// positions and Laplacian weights the rows of M and M'M; of the factor what the change does not
/// reach; with the same positions the coarse surface of followed drags, of which another handle or
/// belt changes what is near. Results are those of a full preparation bit for bit; frames of a
/// followed drag that a coarse surface leads, which depend on the time they have, go by the coarse
/// surface that is kept. With other positions (after a
/// commit, say) the numbers are computed anew. An edit with another ROI, or other unknowns (hard
/// constraints solve for the free vertices alone, which move with the handle; a loose vertex counts
/// while it is held), is prepared in full, and what is kept is then that. A preparation that is
/// cancelled or fails loses nothing that was kept before it.
///
/// Earlier deformers stay right. Dragging them costs what it did, also while the next one is being
/// prepared on another thread. They have one factor in common with the later ones, so `solve`
/// and `follow` of an earlier one wait for a preparation under way and factor again first.
///
/// Memory: that of one Deformer's factors, while this or a deformer made from it lives. One
/// preparation at a time.
class PreparedRegion {
 public:
  /// Nothing is kept yet. `topology` must outlive the object and what is prepared with it.
  explicit PreparedRegion(const Topology& topology) : topology_(topology) {}
  /// Kept are pattern and order of `like`, ordered and of the same topology, while it goes on to
  /// serve others; nothing where it is null.
  PreparedRegion(const Topology& topology, std::shared_ptr<const RegionSystem> like)
      : topology_(topology), like_(std::move(like)) {}

  const Topology& topology() const { return topology_; }

  /// For DragPreview and Deformer: whether the systems kept serve an edit over `unknowns`.
  bool serves(const VertexSet& roi, const Unknowns& unknowns) const;
  /// Likewise: those, or new ones.
  std::shared_ptr<RegionSystem> system_of(const VertexSet& roi, const Unknowns& unknowns);
  /// Likewise: a copy of `rest`, the one kept if that is the same bit for bit.
  std::shared_ptr<const Positions> copy_of(std::span<const Eigen::Vector3d> rest);

 private:
  const Topology& topology_;
  std::shared_ptr<const RegionSystem> like_;  ///< or null
  std::shared_ptr<RegionSystem> system_;
  std::shared_ptr<const Positions> rest_;
};

}  // namespace lapwing
