#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "lapwing/laplacian/constraints.h"

namespace lapwing {

/// What `wanted`, one vector for each vertex of the mesh, says of those of `roi` that are not
/// solved for, and 0 elsewhere: what a right-hand side has to account for. Empty where that is
/// nothing, as with soft constraints, so that no field over the mesh is made for it.
inline std::vector<Eigen::Vector3d> given_displacement(std::span<const Index> roi,
                                                       const Unknowns& unknowns,
                                                       std::span<const Eigen::Vector3d> wanted) {
  const auto is_given = [&](Index v) {
    return unknowns.of_vertex[v] == kNoIndex && !wanted[v].isZero(0.0);
  };
  std::vector<Eigen::Vector3d> given;
  if (std::none_of(roi.begin(), roi.end(), is_given)) return given;
  given.assign(wanted.size(), Eigen::Vector3d::Zero());
  for (const Index v : roi) {
    if (is_given(v)) given[v] = wanted[v];
  }
  return given;
}

}  // namespace lapwing
