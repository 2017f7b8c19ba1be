#pragma once

#include <span>
#include <vector>

#include "lapwing/mesh/topology.h"

namespace lapwing::remeshing {

/// An editable half-edge mesh on index arrays: half-edge 3 t + k runs from corner k of triangle t
/// to the next corner. Every vertex has one fan of triangles, closed or open. A half-edge on a line
/// stores the index of a side of the line: the two half-edges of a line edge store s and s ^ 1, and
/// each border half-edge its own index. Operations preserve the sides. They do not check their
/// preconditions.
class Halfedges {
 public:
  Halfedges() = default;
  /// `twins` contains the opposite of each half-edge, or kNoIndex on the border.
  Halfedges(std::size_t vertex_count, std::span<const Triangle> triangles,
            std::vector<Index> twins);

  static Index next(Index h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static Index previous(Index h) { return h % 3 == 0 ? h + 2 : h - 1; }

  std::size_t halfedge_count() const { return origins_.size(); }
  std::size_t triangle_count() const { return origins_.size() / 3; }
  std::size_t vertex_count() const { return outgoing_.size(); }

  Index origin(Index h) const { return origins_[h]; }
  Index target(Index h) const { return origins_[next(h)]; }
  Index apex(Index h) const { return origins_[previous(h)]; }
  Index twin(Index h) const { return twins_[h]; }
  Index side(Index h) const { return sides_[h]; }
  void set_side(Index h, Index side) { sides_[h] = side; }
  bool on_line(Index h) const { return sides_[h] != kNoIndex; }

  bool is_alive(Index h) const { return origins_[h] != kNoIndex; }
  bool has_vertex(Index v) const { return outgoing_[v] != kNoIndex; }
  /// Returns the outgoing half-edge from which a counterclockwise traversal about `v` visits all
  /// others. At a border vertex, it is the half-edge without a twin.
  Index outgoing(Index v) const { return outgoing_[v]; }
  bool is_border_vertex(Index v) const { return twins_[outgoing_[v]] == kNoIndex; }

  /// Returns the next outgoing half-edge of the same vertex, counterclockwise, or kNoIndex after
  /// the last triangle.
  Index turn(Index h) const { return twins_[previous(h)]; }

  /// Calls `visit(h)` for the outgoing half-edges of `v`, counterclockwise, one for each triangle
  /// around `v`.
  template <class Visit>
  void for_outgoing(Index v, const Visit& visit) const {
    const Index first = outgoing_[v];
    Index h = first;
    do {
      const Index following = turn(h);
      visit(h);
      h = following;
    } while (h != kNoIndex && h != first);
  }

  /// Calls `visit(w)` for the neighbours of `v`, counterclockwise.
  template <class Visit>
  void for_neighbours(Index v, const Visit& visit) const {
    for_outgoing(v, [&](Index h) {
      visit(target(h));
      if (turn(h) == kNoIndex) visit(apex(h));
    });
  }
  int valence(Index v) const;

  /// Splits the edge of `h`, which must not be on the border, and returns the new vertex.
  /// Afterwards, `h` ends at the new vertex. The two new triangles are appended.
  Index split(Index h);
  /// Flips the edge of `h` so that it joins the two apexes. It must not be on a line or border.
  void flip(Index h);
  /// Collapses the origin of `h`, which must have a closed fan, into its target, and removes the
  /// two triangles of the edge. Requires the link condition. The two edges that are merged on
  /// either side must not both be on lines.
  void collapse(Index h);

 private:
  void glue(Index h, Index twin);
  void merge_edges(Index to_apex, Index from_apex);

  std::vector<Index> origins_;  ///< kNoIndex if removed
  std::vector<Index> twins_;
  std::vector<Index> sides_;
  std::vector<Index> outgoing_;  ///< per vertex; kNoIndex if removed
};

}  // namespace lapwing::remeshing
