#pragma once

#include <span>
#include <vector>

#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// A closed surface that is consistently oriented, at least after Orientation::faces_to_flip are
/// flipped.
struct ClosedSheet {
  std::vector<Index> faces;
  double volume = 0.0;    ///< enclosed volume; negative if oriented inward
  bool may_turn = false;  ///< whether it is consistent, so that all its faces may be flipped
};

/// Returns, for each sheet, the sheets that contain it, in ascending order. Sheet A contains sheet
/// B if A has the larger absolute volume and encloses the first corner of B. If A and B intersect,
/// only this corner decides. The cost is usually near-linear. It is quadratic if the x range of
/// every triangle contains the first corners of many sheets.
std::vector<std::vector<Index>> containers_of(const Mesh& mesh,
                                              std::span<const ClosedSheet> sheets);

}  // namespace lapwing
