#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "lapwing/laplacian/constraints.h"

namespace lapwing {

/// Returns `wanted`, one vector per vertex of the mesh, at the vertices of `roi` that are not
/// unknowns, and 0 elsewhere. Right-hand sides must account for it. Returns an empty vector if all
/// are 0, as with soft constraints, to save a field over the mesh.
inline std::vector<Eigen::Vector3d> dirichlet_values(std::span<const Index> roi,
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
