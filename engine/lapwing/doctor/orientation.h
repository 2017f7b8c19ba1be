#pragma once

#include <vector>

#include "lapwing/mesh/edges.h"

namespace lapwing {

/// Lists the polygons to flip so that the orientation is consistent. Polygons that share an edge
/// with exactly two sides belong to the same sheet. Two such polygons are consistent if they
/// traverse the edge in opposite directions.
struct Orientation {
  /// Edges whose two sides run in the same direction, in sheets that flipping faces can repair.
  std::vector<Index> inconsistent_edges;
  /// The same in one-sided sheets (a Moebius strip), where no choice of flips repairs all of them.
  std::vector<Index> one_sided_edges;
  /// Faces to flip so that no inconsistent edge is left. In a closed sheet, these flips make the
  /// enclosed volume positive. In an open sheet, they are as few as possible. If two choices have
  /// the same number of flips, the first face of the sheet is not flipped.
  std::vector<Index> faces_to_flip;

  /// The smallest vertex of each closed sheet that is inside out. These sheets are oriented inward
  /// but are not cavities. A cavity is oriented inward and lies inside a solid.
  std::vector<Index> inside_out;
  /// The faces of the sheets in `inside_out`, and of the sheets inside them that must be flipped
  /// with them. A solid that is inside out thus keeps its cavities.
  std::vector<Index> faces_to_turn;
  /// The smallest vertex of each open sheet that encloses a negative volume if a fan closes every
  /// hole. Sheets much flatter than a hemisphere have no inner side and are never listed.
  std::vector<Index> inward_open;
};

/// Analyzes the orientation, usually in near-linear time. `edges` must be the edges of `mesh`. All
/// lists are in ascending order.
Orientation analyze_orientation(const Mesh& mesh, const Edges& edges);

/// Orientation of the connected component that contains a vertex.
enum class Facing {
  outward,      ///< oriented outward, or without a definite outer side
  inside_out,   ///< contains a sheet of Orientation::inside_out
  inward_open,  ///< contains a sheet of Orientation::inward_open
};
Facing facing_of(const Mesh& mesh, Index vertex);

}  // namespace lapwing
