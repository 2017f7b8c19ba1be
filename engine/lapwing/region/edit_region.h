#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lapwing/region/border_belt.h"
#include "lapwing/region/falloff.h"
#include "lapwing/region/stiffness.h"
#include "lapwing/region/targets.h"

namespace lapwing {

/// Treatment of a component that nothing holds, or that could rotate freely.
enum class LoosePolicy {
  carry,   ///< move it with the nearest surface
  leave,   ///< leave it in place
  refuse,  ///< throw InputError
};

/// An anchor of a loose part: a vertex that the belt, a handle or a target holds, or a neighbour
/// outside the ROI.
struct LooseAnchor {
  Index vertex = 0;
  std::size_t handle = 0;                                  ///< EditRegion::handles.size() if none
  Eigen::Vector3d displacement = Eigen::Vector3d::Zero();  ///< used if there is no handle
  bool operator==(const LooseAnchor&) const = default;
};

/// A component of the ROI that is not solved for because its anchors do not fix it.
struct LoosePart {
  VertexSet vertices;
  std::vector<LooseAnchor> anchors;  ///< all are on one line
  bool operator==(const LoosePart&) const = default;
};

/// The vertices of one edit. Vertices of the ROI that are neither in the belt nor in a handle are
/// free; they include graded vertices. Vertices outside the ROI do not move, except in loose parts.
struct EditRegion {
  VertexSet roi;
  VertexSet belt;                  ///< in the ROI; does not move
  std::vector<VertexSet> handles;  ///< in the ROI, not empty, disjoint from each other and the belt
  /// Falloff::weight per handle; may be empty.
  std::vector<std::optional<double>> handle_weights = {};
  std::vector<FalloffVertex> graded = {};  ///< ascending; free vertices without hard targets
  /// Stiffness factors of vertices in the ROI, in ascending order of vertices. The factor of all
  /// other vertices is 1.
  std::vector<VertexStiffness> stiffness = {};
  std::vector<Target> targets = {};        ///< in the ROI, none at a vertex of belt or handles
  bool hard_targets = false;               ///< whether targets are reached exactly
  std::vector<LoosePart> loose = {};     ///< parts that follow the surface; disjoint from all above
  std::vector<VertexSet> left_out = {};  ///< parts that do not move; disjoint from all above
  /// Whether components of the ROI may rotate about a line of anchors, because there is no fixed
  /// component that they could follow. Their rotation is as small as possible.
  bool turns_freely = false;
  std::vector<Index> held_holes = {};  ///< BorderBelt::held_holes of the belt
  bool operator==(const EditRegion&) const = default;

  /// Returns the number of free vertices.
  std::size_t free_count() const;
};

/// Resolves the input of a user on a mesh. A BoundaryAnchors belt excludes handles and targets. A
/// falloff ends at the belt, at other handles and at hard targets. If two falloffs overlap, a
/// vertex follows the handle with the larger weight (`falloff_around`). Throws InputError, naming
/// the location and vertices, if the ROI or a handle is empty, a handle or the belt leaves the ROI,
/// handles overlap each other or the belt, a field does not have a weight from 0 to 1 for each
/// vertex, or the ROI or its one-rings are not finite. Also throws the errors of `resolve`,
/// `require_extent`, `require_falloff`, `split_by_field`, `resolve_targets` and
/// `separate_loose_parts`.
EditRegion resolve_edit_region(const RegionSpec& roi, const BeltSpec& belt,
                               std::span<const HandleSpec> handles, const Mesh& mesh,
                               LoosePolicy policy = LoosePolicy::carry,
                               const TargetSpec& targets = {});

/// Moves the components of the ROI for which `check_anchors` would fail to `loose` or `left_out`.
/// If it would fail for all components, those with an anchor remain, and `turns_freely` is set.
/// Throws InputError if the policy is LoosePolicy::refuse, or if a handle would have no vertices
/// afterwards.
void separate_loose_parts(EditRegion& region, std::span<const Eigen::Vector3d> positions,
                          const Topology& topology, LoosePolicy policy, const std::string& where);

/// Throws InputError unless every component of the ROI has three anchors that are not on one line.
/// Anchors are vertices of handles and belt, corners of targets, and neighbours outside the ROI. If
/// `turns_freely` is set, one anchor is enough. The message contains `where` and the size and
/// smallest vertex of the component. Vertices with an empty ring need no anchor.
void check_anchors(const EditRegion& region, std::span<const Eigen::Vector3d> positions,
                   const Topology& topology, const std::string& where);

}  // namespace lapwing
