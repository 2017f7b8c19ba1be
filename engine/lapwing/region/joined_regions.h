#pragma once

#include "lapwing/mesh/joined_surface.h"
#include "lapwing/region/edit_region.h"

namespace lapwing {

// Regions of a mesh with seams, over the surface with its seams joined: a follower that is named
// means its leader.

/// The leaders that `spec` chooses. Throws what `resolve` does.
VertexSet resolve_leaders(const RegionSpec& spec, const JoinedSurface& joined);

/// Those as a list.
RegionSpec led(const RegionSpec& spec, const JoinedSurface& joined);
/// `belt` over the joined surface: one by fraction as it is, a region as the list of its leaders.
BeltSpec led(const BeltSpec& belt, const JoinedSurface& joined);
/// The same targets, at leaders.
TargetSpec led(TargetSpec targets, const JoinedSurface& joined);

/// The same grading: of a painted field, a leader has the largest weight of those that follow it.
Grading led(Grading grading, const JoinedSurface& joined);

/// The set of leaders with the vertices that follow them.
VertexSet with_followers(const VertexSet& leaders, const JoinedSurface& joined);
/// The same for every set of an edit; targets stay at leaders.
EditRegion with_followers(EditRegion region, const JoinedSurface& joined);

}  // namespace lapwing
