#pragma once

#include <span>
#include <vector>

#include "lapwing/mesh/topology.h"

namespace lapwing::remeshing {

/// Triangles that change, as half-edges on index arrays: half-edge 3 t + k runs from corner k of
/// triangle t to the next corner. Every vertex has one fan of triangles, closed or open. Half-edges
/// can carry a side: one side of a line that has to stay. The two half-edges of a line's edge carry
/// the sides s and s ^ 1, those of a border carry one each. Operations keep sides where the lines
/// are and require what their comments say; they check nothing.
class Halfedges {
 public:
  Halfedges() = default;
  /// `twins`: per half-edge the opposite one, kNoIndex on the border.
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
  /// The half-edge from which turning counterclockwise about `v` meets all others: on the border
  /// the one without a twin.
  Index outgoing(Index v) const { return outgoing_[v]; }
  bool is_border_vertex(Index v) const { return twins_[outgoing_[v]] == kNoIndex; }

  /// The next half-edge out of the same vertex, counterclockwise; kNoIndex past the last triangle.
  Index turn(Index h) const { return twins_[previous(h)]; }
  /// The same, clockwise.
  Index turn_back(Index h) const { return twins_[h] == kNoIndex ? kNoIndex : next(twins_[h]); }

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

  /// Puts a new vertex onto the edge of `h`, which is not on the border, and returns it. `h` then
  /// runs from its origin to the new vertex. The triangles' new halves are the last two.
  Index split(Index h);
  /// Turns the edge of `h`, not on a line or border, to join the two apexes.
  void flip(Index h);
  /// Moves the origin of `h`, which has a closed fan, into its target, and removes it with the two
  /// triangles on the edge. Requires the link condition, and that the two edges that fall together
  /// on either side are not both lines.
  void collapse(Index h);

 private:
  void glue(Index h, Index twin);
  void fall_together(Index to_apex, Index from_apex);

  std::vector<Index> origins_;  ///< kNoIndex: removed
  std::vector<Index> twins_;
  std::vector<Index> sides_;
  std::vector<Index> outgoing_;  ///< per vertex; kNoIndex: removed
};

}  // namespace lapwing::remeshing
