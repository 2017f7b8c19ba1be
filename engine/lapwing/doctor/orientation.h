#pragma once

#include <vector>

#include "lapwing/mesh/edges.h"

namespace lapwing {

/// Whether the polygons agree on which side is out, and whether it is the outer one. Polygons that
/// share an edge with exactly two sides belong to one sheet. They agree if they traverse that edge
/// in opposite directions.
struct Orientation {
  /// Edges whose two sides run in the same direction, in sheets that flipping faces can repair.
  std::vector<Index> inconsistent_edges;
  /// The same in one-sided sheets (a Moebius strip), where no choice of flips repairs all of them.
  std::vector<Index> one_sided_edges;
  /// Faces to flip so that no inconsistent edge is left. In a closed sheet, this makes the enclosed
  /// volume positive. In an open one they are the smaller half, or on a tie the half without the
  /// sheet's first face.
  std::vector<Index> faces_to_flip;

  /// The closed sheets that are inside out, each by its smallest vertex: oriented inward, but no
  /// cavity of another one. A cavity is oriented inward and lies inside a solid.
  std::vector<Index> inside_out;
  /// The faces of these sheets, and of the sheets inside them that turn with them: a solid that is
  /// inside out keeps its cavities.
  std::vector<Index> faces_to_turn;
  /// The open sheets, each by its smallest vertex, that enclose a negative volume if every hole is
  /// closed by a fan. Sheets much flatter than a hemisphere have no inner side and are never
  /// listed.
  std::vector<Index> inward_open;
};

/// Analyzes the orientation, usually in near-linear time. `edges` must be those of `mesh`. Lists
/// are ascending.
Orientation analyze_orientation(const Mesh& mesh, const Edges& edges);

/// How the connected component of a vertex faces.
enum class Facing {
  outward,      ///< or undecided
  inside_out,   ///< has a sheet of Orientation::inside_out
  inward_open,  ///< has a sheet of Orientation::inward_open
};
Facing facing_of(const Mesh& mesh, Index vertex);

}  // namespace lapwing
