#pragma once

#include <cstddef>
#include <span>

#include "lapwing/mesh/topology.h"
#include "lapwing/region/edit_region.h"
#include "studies/real/ends_motion.h"

namespace lapwing::bench {

/// The part of a mesh that its two ends hold.
struct HeldRegion {
  EditRegion region;         ///< with one handle
  std::size_t left_out = 0;  ///< number of the mesh's other vertices
};

/// Returns the whole mesh without loose vertices and without the components that `check_anchors`
/// refuses: those in which belt and handle hold no three vertices off one line. Throws InputError
/// if no vertex of the belt or none of the handle is left.
HeldRegion held_region(const MovedEnds& ends, std::span<const Eigen::Vector3d> positions,
                       const Topology& topology);

}  // namespace lapwing::bench
