#pragma once

#include <cstddef>

#include "lapwing/remesh/working_patch.h"

namespace lapwing::remeshing {

/// In target lengths: longer edges are halved, and no collapse makes an edge longer than this.
inline constexpr double kTooLong = 4.0 / 3.0;

/// Each function is one pass over the patch. None turns a triangle over, changes a border edge or
/// joins two vertices that are joined already.

/// Halves edges longer than 4/3 of the target, the longest first, until there are `most_vertices`.
/// Returns whether all were halved. An edge waits for much longer ones of its triangles. Next to a
/// long border edge, which stays, triangles therefore grow gradually.
bool split_long_edges(WorkingPatch& patch, std::size_t most_vertices);

/// Collapses edges shorter than 4/5 of the target, the shortest first. No edge becomes longer than
/// 4/3 of the target, and lines move by at most a tenth of it.
void collapse_short_edges(WorkingPatch& patch);

/// Flips edges towards valence 6, and at fixed vertices towards that of equilateral triangles.
void flip_for_valence(WorkingPatch& patch);

/// Flips edges if that enlarges the smallest angle of their two triangles.
void flip_for_angles(WorkingPatch& patch);

/// Moves every vertex that is not fixed towards the centroid of its neighbourhood, in its tangent
/// plane or along its line, and projects it back onto the original surface.
void relax(WorkingPatch& patch);

}  // namespace lapwing::remeshing
