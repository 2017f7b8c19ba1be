#pragma once

#include <array>

#include "lapwing/remesh/working_patch.h"

namespace lapwing::remeshing {

/// How sharply two triangles meet, against what is allowed on a line and elsewhere: negative when
/// sharper. 1 where one has no area. Takes area vectors.
double fold_margin(const Eigen::Vector3d& a, const Eigen::Vector3d& b, bool on_line);

/// Whether a change that takes the smallest margin of its edges from `before` to `after` makes a
/// fold: an edge sharper than allowed, and sharper than any there before by more than rounding.
bool is_new_fold(double before, double after);

/// Whether the surface folds when `v` moves to `place`; with `into`, a ring neighbour, when both do
/// and become one.
bool folds_when_moved(const WorkingPatch& patch, const Eigen::Vector3d& place, Index v,
                      Index into = kNoIndex);

}  // namespace lapwing::remeshing
