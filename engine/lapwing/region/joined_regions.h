#pragma once

#include "lapwing/mesh/seams.h"
#include "lapwing/region/edit_region.h"

namespace lapwing {

// Regions of a mesh with seams, translated to the joined surface. A follower stands for its leader.

/// Returns the leaders that `spec` chooses. Throws what `resolve` throws.
VertexSet resolve_leaders(const RegionSpec& spec, const JoinedSurface& joined);

/// Returns these leaders as a list.
RegionSpec led(const RegionSpec& spec, const JoinedSurface& joined);
/// Returns `belt` on the joined surface. A belt by fraction stays; a region becomes a list of
/// leaders.
BeltSpec led(const BeltSpec& belt, const JoinedSurface& joined);
/// Returns the same targets at leaders.
TargetSpec led(TargetSpec targets, const JoinedSurface& joined);

/// Returns the same falloff. In a painted field, a leader gets the largest weight of itself and its
/// followers.
Falloff led(Falloff falloff, const JoinedSurface& joined);

/// Returns `leaders` and their followers.
VertexSet with_followers(const VertexSet& leaders, const JoinedSurface& joined);
/// The same for every set of vertices of an edit; targets stay at leaders.
EditRegion with_followers(EditRegion region, const JoinedSurface& joined);

}  // namespace lapwing
