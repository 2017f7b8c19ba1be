#pragma once

#include <array>

#include "lapwing/remesh/working_patch.h"

namespace lapwing::remeshing {

/// Returns the cosine between two triangles, given by area vectors, minus the least one allowed on
/// a line or elsewhere. It is negative if they meet too sharply, and 1 if one has no area.
double fold_margin(const Eigen::Vector3d& a, const Eigen::Vector3d& b, bool on_line);

/// Returns whether a change that takes the smallest margin of its edges from `before` to `after`
/// makes a fold: an edge that is too sharp and, by more than rounding, sharper than all before.
bool is_new_fold(double before, double after);

/// Returns whether the surface folds when `v` moves to `place`. With `into`, a ring neighbour, both
/// move there and become one vertex.
bool folds_when_moved(const WorkingPatch& patch, const Eigen::Vector3d& place, Index v,
                      Index into = kNoIndex);

}  // namespace lapwing::remeshing
