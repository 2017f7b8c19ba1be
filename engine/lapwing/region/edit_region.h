#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lapwing/region/border_belt.h"
#include "lapwing/region/falloff.h"
#include "lapwing/region/targets.h"

namespace lapwing {

/// How to treat a component that nothing holds, or that could turn freely.
enum class LoosePolicy {
  carry,   ///< move it with the nearest surface
  leave,   ///< leave it in place
  refuse,  ///< throw InputError
};

/// A vertex of a loose part that the belt, a handle or a target still holds, or a neighbour of the
/// part outside the ROI.
struct LooseAnchor {
  Index vertex = 0;
  std::size_t handle = 0;                                  ///< EditRegion::handles.size() for none
  Eigen::Vector3d displacement = Eigen::Vector3d::Zero();  ///< used without a handle
  bool operator==(const LooseAnchor&) const = default;
};

/// A component of the ROI that is not solved for because its anchors do not hold it.
struct LoosePart {
  VertexSet vertices;
  std::vector<LooseAnchor> anchors;  ///< all on one line
  bool operator==(const LoosePart&) const = default;
};

/// The vertices of one edit. Those of the ROI in neither belt nor handle are free, including graded
/// ones. Vertices outside the ROI do not move, except in loose parts.
struct EditRegion {
  VertexSet roi;
  VertexSet belt;                  ///< in the ROI; does not move
  std::vector<VertexSet> handles;  ///< in the ROI, not empty, disjoint from each other and the belt
  std::vector<std::optional<double>> handle_weights = {};  ///< Falloff::weight per handle, or empty
  std::vector<FalloffVertex> graded = {};  ///< ascending; free vertices without hard targets
  std::vector<Target> targets = {};        ///< in the ROI, none at a vertex of belt or handles
  bool hard_targets = false;               ///< true if targets are reached exactly
  std::vector<LoosePart> loose = {};       ///< parts that follow; disjoint from all above
  std::vector<VertexSet> left_out = {};    ///< parts that stay; disjoint from all above
  /// True if components of the ROI may turn freely about a line of anchors, because they cannot
  /// follow a better anchored component. They turn as little as possible.
  bool turns_freely = false;
  std::vector<Index> held_holes = {};  ///< BorderBelt::held_holes of the belt
  bool operator==(const EditRegion&) const = default;

  /// Returns the number of vertices of the ROI in neither belt nor handle.
  std::size_t free_count() const;
};

/// Resolves a user's choices on a mesh. A belt by fraction leaves out handles and targets. A
/// falloff ends at the belt, at other handles and at hard targets. If two falloffs overlap, a
/// vertex belongs to the handle with more weight there (`falloff_around`). Every other overlap is
/// an error. Throws InputError, naming place and vertices, for an empty ROI or handle, and for a
/// handle or belt that leaves the ROI. Handles must not overlap each other or the belt. A field
/// needs a weight from 0 to 1 for each vertex, and the ROI and its rings must be finite. Also
/// throws what `resolve`, `require_extent`, `require_falloff`, `split_by_field`, `resolve_targets`
/// and `separate_loose_parts` throw.
EditRegion resolve_edit_region(const RegionSpec& roi, const BeltSpec& belt,
                               std::span<const HandleSpec> handles, const Mesh& mesh,
                               LoosePolicy policy = LoosePolicy::carry,
                               const TargetSpec& targets = {});

/// Moves the components of the ROI that `check_anchors` would refuse to `loose` or `left_out`. If
/// it would refuse all of them, those with an anchor stay and the region `turns_freely`. Throws
/// InputError if the policy is LoosePolicy::refuse, or if a handle would have no vertex left.
void separate_loose_parts(EditRegion& region, std::span<const Eigen::Vector3d> positions,
                          const Topology& topology, LoosePolicy policy, const std::string& where);

/// Throws InputError unless every component of the ROI has three anchors that are not on one line.
/// Anchors are its handle and belt vertices, the corners of its targets and its neighbours outside
/// the ROI. If the region `turns_freely`, one anchor is enough. The message names `where` and the
/// component by size and smallest vertex. Vertices with an empty ring need no anchor.
void check_anchors(const EditRegion& region, std::span<const Eigen::Vector3d> positions,
                   const Topology& topology, const std::string& where);

}  // namespace lapwing
