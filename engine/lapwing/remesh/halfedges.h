#pragma once

#include <span>
#include <vector>

#include "lapwing/mesh/topology.h"

namespace lapwing::remeshing {

/// An editable half-edge mesh on index arrays: half-edge 3 t + k runs from corner k of triangle t
/// to the next corner. Every vertex has one fan of triangles, closed or open. A half-edge on a line
/// carries a side of the line: the half-edges of a line's edge carry s and s ^ 1, and each border
/// half-edge its own. Operations keep these sides. They do not check what their comments require.
class Halfedges {
 public:
  Halfedges() = default;
  /// `twins` holds the opposite of each half-edge, kNoIndex on the border.
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
  /// Returns the half-edge from which turning counterclockwise about `v` meets all others. On the
  /// border it is the one without a twin.
  Index outgoing(Index v) const { return outgoing_[v]; }
  bool is_border_vertex(Index v) const { return twins_[outgoing_[v]] == kNoIndex; }

  /// The next half-edge out of the same vertex, counterclockwise; kNoIndex past the last triangle.
  Index turn(Index h) const { return twins_[previous(h)]; }

  /// Calls `visit(h)` for the half-edges out of `v`, counterclockwise; their triangles are those
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

  /// Calls `visit(w)` for the ring neighbours of `v`, counterclockwise.
  template <class Visit>
  void for_neighbours(Index v, const Visit& visit) const {
    for_outgoing(v, [&](Index h) {
      visit(target(h));
      if (turn(h) == kNoIndex) visit(apex(h));
    });
  }
  int valence(Index v) const;

  /// Splits the edge of `h`, which must not be on the border, and returns the new vertex. `h` then
  /// runs from its origin to the new vertex. The two new triangles are the last ones.
  Index split(Index h);
  /// Flips the edge of `h`, which must not be on a line or border, so that it joins the two apexes.
  void flip(Index h);
  /// Collapses the origin of `h`, which must have a closed fan, into its target, and removes the
  /// two triangles on the edge. Requires the link condition, and that the two edges that become one
  /// on either side are not both lines.
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
