#pragma once

#include <cstddef>

#include "lapwing/remesh/working_patch.h"

namespace lapwing::remeshing {

/// In units of the target length. Longer edges are split, and no collapse makes an edge longer than
/// this.
inline constexpr double kTooLong = 4.0 / 3.0;

/// Each function is one pass over the patch. No pass inverts a triangle, changes a border edge or
/// adds an edge that already exists.

/// Splits edges longer than 4/3 of the target length in half, the longest first, until there are
/// `most_vertices`. Returns whether all were split. An edge is not split before much longer edges
/// of its triangles, so triangles are gradually larger near a long border edge, which is never
/// split.
bool split_long_edges(WorkingPatch& patch, std::size_t most_vertices);

/// Collapses edges shorter than 4/5 of the target length, the shortest first. No edge becomes
/// longer than 4/3 of the target length, and lines move by at most a tenth of it.
void collapse_short_edges(WorkingPatch& patch);

/// Flips edges to approach valence 6 or, at fixed vertices, the valence of equilateral triangles.
void flip_for_valence(WorkingPatch& patch);

/// Flips edges if this increases the smallest angle of their two triangles.
void flip_for_angles(WorkingPatch& patch);

/// Moves every vertex that is not fixed towards the centroid of its neighbourhood, in its tangent
/// plane or along its line, and projects it back onto the original surface.
void relax(WorkingPatch& patch);

}  // namespace lapwing::remeshing
