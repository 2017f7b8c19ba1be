#pragma once

#include "lapwing/mesh/seams.h"
#include "lapwing/region/edit_region.h"

namespace lapwing {

// Conversion of regions between a mesh with seams and the joined surface. Followers are replaced by
// their leaders.

/// Returns the leaders that `spec` selects. Throws the errors of `resolve`.
VertexSet resolve_leaders(const RegionSpec& spec, const JoinedSurface& joined);

/// Returns the leaders that `spec` selects as a list.
RegionSpec led(const RegionSpec& spec, const JoinedSurface& joined);
/// Returns `belt` on the joined surface. BoundaryAnchors do not change; a region becomes a list of
/// leaders.
BeltSpec led(const BeltSpec& belt, const JoinedSurface& joined);
/// Returns `targets` with vertices replaced by their leaders.
TargetSpec led(TargetSpec targets, const JoinedSurface& joined);

/// Returns `falloff` on the joined surface. In a painted field, a leader gets the largest weight
/// among itself and its followers.
Falloff led(Falloff falloff, const JoinedSurface& joined);
/// Returns `spec` on the joined surface. In a painted field, a leader gets the largest factor among
/// itself and its followers.
StiffnessSpec led(StiffnessSpec spec, const JoinedSurface& joined);

VertexSet with_followers(const VertexSet& leaders, const JoinedSurface& joined);
/// Adds followers to every vertex set of an edit. Targets remain at leaders.
EditRegion with_followers(EditRegion region, const JoinedSurface& joined);

}  // namespace lapwing
