#pragma once

#include <span>
#include <string>
#include <vector>

#include "lapwing/region/border_belt.h"
#include "lapwing/region/grading.h"
#include "lapwing/region/targets.h"

namespace lapwing {

/// What becomes of a component that nothing holds, or that could turn freely.
enum class LoosePolicy {
  carry,   ///< it rides along with the surface nearest to it
  leave,   ///< it stays where it is
  refuse,  ///< an error
};

/// A vertex of a loose part that belt, handle or target hold all the same.
struct LooseAnchor {
  Index vertex = 0;
  std::size_t handle = 0;                                  ///< EditRegion::handles.size() for none
  Eigen::Vector3d displacement = Eigen::Vector3d::Zero();  ///< without a handle
  bool operator==(const LooseAnchor&) const = default;
};

/// A component of the ROI that is not solved for, since too little holds it.
struct LoosePart {
  VertexSet vertices;
  std::vector<LooseAnchor> anchors;  ///< all on one line
  bool operator==(const LoosePart&) const = default;
};

/// What one edit concerns. Vertices of the ROI in neither belt nor handle are free, those that a
/// handle draws by less than its full weight included; vertices outside the ROI do not move, loose
/// parts excepted.
struct EditRegion {
  VertexSet roi;
  VertexSet belt;                  ///< in the ROI; stays where it is
  std::vector<VertexSet> handles;  ///< in the ROI, disjoint, not empty, none shared with the belt
  std::vector<double> handle_weights = {};  ///< Grading::weight of each; empty: all 1
  std::vector<GradedVertex> graded = {};    ///< ascending, free; none has a hard target
  std::vector<Target> targets = {};         ///< in the ROI, none at a vertex of belt or handles
  bool hard_targets = false;                ///< they are reached exactly
  std::vector<LoosePart> loose = {};        ///< to be carried; in none of the above
  std::vector<VertexSet> left_out = {};     ///< loose parts that stay; likewise
  /// Components of the ROI may turn freely about a line of anchors: nothing firmer is there that
  /// could carry them. They turn as little as they can.
  bool turns_freely = false;
  bool operator==(const EditRegion&) const = default;

  /// How many vertices of the ROI are in neither belt nor handle.
  std::size_t free_count() const;
};

/// Binds what a person chose to a mesh. A belt by fraction leaves handles and targets out, a
/// falloff ends at the belt, at other handles and at hard targets, and where two meet a vertex goes
/// with the handle that has more weight there (`graded_around`); every other overlap is an error.
/// Throws InputError, naming place and vertices: whatever `resolve` throws, an empty ROI or handle,
/// a handle or belt outside the ROI, a handle that overlaps the belt or another handle, a field
/// that is not one of weights of the mesh, a vertex of the ROI or of its rings that is not finite,
/// and what `require_grading`, `split_by_field`, `resolve_targets` and `set_loose_parts_aside`
/// throw.
EditRegion resolve_edit_region(const RegionSpec& roi, const BeltSpec& belt,
                               std::span<const HandleSpec> handles, const Mesh& mesh,
                               LoosePolicy policy = LoosePolicy::carry,
                               const TargetSpec& targets = {});

/// Moves the components of the ROI that `check_anchors` would refuse to `loose` or `left_out`;
/// where no other is there those stay that have an anchor, and the region `turns_freely`. Throws as
/// that does for LoosePolicy::refuse, and where no component, or no vertex of a handle, would be
/// left that is held.
void set_loose_parts_aside(EditRegion& region, std::span<const Eigen::Vector3d> positions,
                           const Topology& topology, LoosePolicy policy, const std::string& where);

/// Throws InputError unless every component of the ROI is held: its anchors are its handle and belt
/// vertices, the corners of its targets and its neighbours outside the ROI, and three of them must
/// not lie on one line, or the component could turn freely (which a region may that
/// `turns_freely`). Names the component by size and smallest vertex, and `where`. Vertices with an
/// empty ring need no anchor.
void check_anchors(const EditRegion& region, std::span<const Eigen::Vector3d> positions,
                   const Topology& topology, const std::string& where);

}  // namespace lapwing
