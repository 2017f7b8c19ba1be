#pragma once

#include <vector>

#include "lapwing/mesh/edges.h"

namespace lapwing {

/// Lists the polygons to flip so that the orientation is consistent. Two polygons belong to the
/// same sheet if they are the only polygons at an edge. They are consistent if they traverse this
/// edge in opposite directions.
struct Orientation {
  /// Edges that two polygons traverse in the same direction, in sheets that flips of faces can
  /// repair.
  std::vector<Index> inconsistent_edges;
  /// Inconsistent edges of one-sided sheets, such as a Moebius strip. No choice of flips can repair
  /// all of them.
  std::vector<Index> one_sided_edges;
  /// Faces to flip so that no inconsistent edge remains. In a closed sheet, these flips make the
  /// enclosed volume positive. In an open sheet, their number is minimal. If two choices have the
  /// same number of flips, the first face of the sheet is not flipped.
  std::vector<Index> faces_to_flip;

  /// The smallest vertex of each closed sheet that is inside out. These sheets are oriented inward
  /// but are not cavities. A cavity is oriented inward and is inside a solid.
  std::vector<Index> inside_out;
  /// The faces of the sheets in `inside_out`, and of sheets inside these that must be flipped
  /// together with them, so that cavities remain cavities.
  std::vector<Index> faces_to_turn;
  /// The smallest vertex of each open sheet that encloses a negative volume after a fan closes each
  /// hole. Sheets that are much flatter than a hemisphere have no inner side and are never listed.
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
