#pragma once

#include <array>

#include "lapwing/remesh/working_patch.h"

namespace lapwing::remeshing {

/// Returns the cosine of the angle between two triangles, given by their area vectors, minus the
/// smallest allowed cosine. It is negative if the edge is too sharp, and 1 if a triangle is
/// degenerate.
double fold_margin(const Eigen::Vector3d& a, const Eigen::Vector3d& b, bool on_line);

/// Returns whether a change of the smallest margin of some edges from `before` to `after` is a
/// fold: an edge becomes too sharp and, by more than rounding errors, sharper than all edges
/// before.
bool is_new_fold(double before, double after);

/// Returns whether the surface folds if `v` moves to `place`. If the neighbour `into` is given,
/// both vertices move there and are merged.
bool folds_when_moved(const WorkingPatch& patch, const Eigen::Vector3d& place, Index v,
                      Index into = kNoIndex);

}  // namespace lapwing::remeshing
