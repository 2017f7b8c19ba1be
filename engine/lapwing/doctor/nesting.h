#pragma once

#include <span>
#include <vector>

#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// A closed surface that is consistently oriented, or will be after Orientation::faces_to_flip are
/// flipped.
struct ClosedSheet {
  std::vector<Index> faces;
  double volume = 0.0;    ///< enclosed volume; negative if oriented inward
  bool may_turn = false;  ///< whether it is consistent, so that all its faces can turn
};

/// Returns the sheets that contain each sheet, in ascending order. A sheet contains another one if
/// its volume is larger and it encloses the first corner of the other. If sheets intersect, only
/// that corner counts. The cost is usually near-linear, but quadratic if every triangle spans many
/// sheets.
std::vector<std::vector<Index>> containers_of(const Mesh& mesh,
                                              std::span<const ClosedSheet> sheets);

}  // namespace lapwing
