#pragma once

#include <vector>

#include "lapwing/mesh/edges.h"

namespace lapwing {

/// Whether the polygons agree on which side is out. Polygons that share an edge with exactly two
/// sides belong to one sheet. They agree if they traverse that edge in opposite directions.
struct Orientation {
  /// Edges whose two sides run in the same direction, in sheets that flipping faces can repair.
  std::vector<Index> inconsistent_edges;
  /// The same in one-sided sheets (a Moebius strip), where no choice of flips repairs all of them.
  std::vector<Index> one_sided_edges;
  /// Faces to flip so that no inconsistent edge is left. In a closed sheet, this makes the enclosed
  /// volume positive. In an open one they are the smaller half, or on a tie the half without the
  /// sheet's first face. Consistent sheets stay, inward or outward, because a cavity is oriented
  /// inward.
  std::vector<Index> faces_to_flip;
};

/// Analyzes the orientation in linear time. `edges` must be those of `mesh`. Lists are ascending.
Orientation analyze_orientation(const Mesh& mesh, const Edges& edges);

}  // namespace lapwing
