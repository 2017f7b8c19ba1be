#pragma once

#include <cstddef>

#include "lapwing/remesh/working_patch.h"

namespace lapwing::remeshing {

/// Of the target: an edge longer than this is halved, and no collapse makes one longer.
inline constexpr double kTooLong = 4.0 / 3.0;

/// One pass each over the patch. None turns a triangle over, touches a border edge or joins two
/// vertices that are joined already.

/// Halves edges longer than 4/3 of the target, the longest first, until there are `most_vertices`.
/// Returns whether all were halved. An edge waits for those around it that are much longer; next to
/// a long border edge, which stays, triangles therefore grow gradually.
bool split_long_edges(WorkingPatch& patch, std::size_t most_vertices);

/// Collapses edges shorter than 4/5 of the target, the shortest first, where no edge becomes longer
/// than 4/3 and lines stay within a tenth of the target of where they were.
void collapse_short_edges(WorkingPatch& patch);

/// Flips edges towards valence 6 inside, and that of equilateral triangles at fixed vertices.
void flip_for_valence(WorkingPatch& patch);

/// Flips edges where that enlarges the smallest angle of their two triangles.
void flip_for_angles(WorkingPatch& patch);

/// Moves every vertex that may move towards the centroid of its neighbourhood, in its tangent plane
/// or along its line, and back onto the original surface.
void relax(WorkingPatch& patch);

}  // namespace lapwing::remeshing
