#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "lapwing/mesh/edges.h"
#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// A boundary loop of the surface.
struct Hole {
  /// The vertices in order, each once, starting at the smallest. The polygon with these corners has
  /// the orientation of a face that closes the hole. If there is a `trouble`, the vertices are in
  /// ascending order instead.
  std::vector<Index> rim;
  double perimeter = 0.0;
  /// Whether the loop is the border of an open sheet instead of a hole. A part of the surface is a
  /// sheet if it is flatter than a hemisphere: P^2 > 2 pi A, where P is the length of its longest
  /// loop and A its area. That loop is then its border.
  bool is_border = false;
  /// Why the loop cannot be filled, and the next step; empty if it can.
  std::string trouble;
};

/// Returns all boundary loops, those with the most vertices first. A loop that visits a point more
/// than once, such as a bow-tie vertex, is split there into several holes. If several vertices
/// coincide at the point, filling these holes creates unwelded seams, which `fix` welds. Loops that
/// touch an edge of more than two faces, a vertex that is not finite, or faces of opposite
/// orientation have a `trouble`, and so has the loop of a part that is a single face. Unwelded
/// seams are joined (joined_surface), so they are not holes, and rims use the leaders of joined
/// vertices. Near-linear.
std::vector<Hole> find_holes(const Mesh& mesh);
/// The same for a mesh without unwelded seams, whose edges and fans are known.
std::vector<Hole> find_holes(const Mesh& mesh, const Edges& edges, const Fans& fans);

/// Returns a description for messages: "the hole with 12 rim vertices at vertex 5".
std::string name_hole(const Hole& hole);

/// Selects holes.
struct HoleChoice {
  std::size_t most_rim_vertices = 0;  ///< larger holes are omitted; 0 for no limit
  bool borders = false;               ///< whether the borders of open sheets count as holes, too
};
/// Returns the holes that `choice` selects, in the same order, with or without a `trouble`.
std::vector<Hole> chosen(const std::vector<Hole>& holes, const HoleChoice& choice);

}  // namespace lapwing
