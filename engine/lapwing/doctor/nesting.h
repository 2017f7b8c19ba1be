#pragma once

#include <span>
#include <vector>

#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// A closed surface, consistently oriented or about to be.
struct ClosedSheet {
  std::vector<Index> faces;
  double volume = 0.0;    ///< enclosed; negative if oriented inward
  bool may_turn = false;  ///< whether it is consistent, so that it can turn as a whole
};

/// Returns for each sheet the others that contain it: those of larger volume around its first
/// corner, ascending. Where sheets intersect, that corner decides. Usually near-linear; quadratic
/// if every triangle spans many sheets.
std::vector<std::vector<Index>> containers_of(const Mesh& mesh,
                                              std::span<const ClosedSheet> sheets);

}  // namespace lapwing
