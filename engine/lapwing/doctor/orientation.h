#pragma once

#include <vector>

#include "lapwing/mesh/edges.h"

namespace lapwing {

/// Whether the polygons agree on which side is out. Polygons that share an edge of exactly two
/// sides belong to one sheet; they agree when they run along that edge in opposite directions.
struct Orientation {
  /// Edges whose two sides run in the same direction, in sheets that flipping faces can mend.
  std::vector<Index> inconsistent_edges;
  /// The same in one-sided sheets (a Moebius strip): no choice of flips mends all of them.
  std::vector<Index> one_sided_edges;
  /// The faces to flip so that no inconsistent edge is left: in a closed sheet those that make the
  /// enclosed volume positive, in an open one the smaller half (the one without the sheet's first
  /// face where both are equal). Sheets that already agree are left alone, inward or outward,
  /// because a cavity is oriented inward.
  std::vector<Index> faces_to_flip;
};

/// Linear. `edges` are those of `mesh`. Lists are ascending.
Orientation analyze_orientation(const Mesh& mesh, const Edges& edges);

}  // namespace lapwing
