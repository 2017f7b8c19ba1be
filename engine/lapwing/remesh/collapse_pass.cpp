#include <algorithm>
#include <array>
#include <queue>

#include "lapwing/base/cancellation.h"
#include "lapwing/remesh/fold_check.h"
#include "lapwing/remesh/passes.h"

namespace lapwing::remeshing {
namespace {

using Eigen::Vector3d;

constexpr double kTooShort = 4.0 / 5.0;

struct ShortEdge {
  double length;
  Index halfedge;
  bool operator<(const ShortEdge& other) const {
    return length != other.length ? length > other.length : halfedge > other.halfedge;
  }
};

class Collapser {
 public:
  explicit Collapser(WorkingPatch& patch) : patch_(patch), net_(patch.net) {}

  void run() {
    CancelCheck cancel_check;
    for (Index h = 0; h < net_.halfedge_count(); ++h) {
      cancel_check();
      if (net_.is_alive(h)) consider(h);
    }
    while (!waiting_.empty()) {
      cancel_check();
      const auto [length, h] = waiting_.top();
      waiting_.pop();
      if (!net_.is_alive(h) || net_.twin(h) == kNoIndex) continue;
      if (length != patch_.edge_length(h)) continue;  // the edge has changed and was queued again
      if (!collapse_into_target(h)) collapse_into_target(net_.twin(h));
    }
  }

 private:
  void consider(Index h) {
    if (net_.twin(h) == kNoIndex) return;
    h = std::min(h, net_.twin(h));
    const double length = patch_.edge_length(h);
    const double wanted = patch_.wanted_length(net_.origin(h), net_.target(h));
    if (length < kTooShort * wanted) waiting_.push({length, h});
  }

  // Returns whether the kind of the origin of `h` allows a move to the target of `h`.
  bool kinds_allow(Index h) const {
    const VertexKind from = patch_.kinds[net_.origin(h)];
    if (from == VertexKind::fixed) return false;
    return from == VertexKind::free || net_.on_line(h);
  }

  // Checks the link condition: the two apexes are the only common neighbours of the two ends.
  bool stays_manifold(Index h) const {
    const Index v = net_.origin(h);
    const Index u = net_.target(h);
    const Index a = net_.apex(h);
    const Index b = net_.apex(net_.twin(h));
    bool fine = !patch_.is_same(a, b);
    for (const Index apex : {a, b}) {
      fine = fine && (net_.is_border_vertex(apex) || net_.valence(apex) > 3);
    }
    net_.for_neighbours(v, [&](Index w) {
      if (!fine || w == u || w == a || w == b) return;
      fine = !patch_.is_same(w, u) && !patch_.are_joined(u, w);
    });
    const auto both_lines = [&](Index side) {
      return net_.on_line(Halfedges::next(side)) && net_.on_line(Halfedges::previous(side));
    };
    return fine && !both_lines(h) && !both_lines(net_.twin(h));
  }

  bool collapse_into_target(Index h) {
    if (!kinds_allow(h) || !stays_manifold(h)) return false;
    const Index u = net_.target(h);
    const Index v = net_.origin(h);
    const Vector3d old = patch_.at(u);
    if (patch_.kinds[u] == patch_.kinds[v]) {
      const Vector3d middle = 0.5 * (old + patch_.at(v));
      if (try_at(h, patch_.project(u, middle, patch_.normal_at(u)))) return true;
    }
    return try_at(h, old);
  }

  bool try_at(Index h, const Vector3d& place) {
    const Index v = net_.origin(h);
    const Index u = net_.target(h);
    const bool moves = place != patch_.at(u);
    const double length = moves ? patch_.target_length.at(place) : patch_.lengths[u];
    if (!edges_stay_short(v, u, place, length)) return false;
    if (moves && !edges_stay_short(u, v, place, length)) return false;
    if (!triangles_allow(v, u, place, moves) || !line_allows(h, place, length, moves)) return false;
    net_.collapse(h);
    patch_.positions[u] = place;
    patch_.lengths[u] = length;
    net_.for_outgoing(u, [&](Index out) {
      consider(out);
      consider(Halfedges::previous(out));
    });
    return true;
  }

  // Returns whether the edges of `v`, except the one to `other`, stay short enough if `v` moves to
  // `place`.
  bool edges_stay_short(Index v, Index other, const Vector3d& place, double length) const {
    bool fine = true;
    net_.for_neighbours(v, [&](Index w) {
      if (w == other) return;
      const double now = rounded_to_seven_digits((patch_.at(w) - place).norm());
      fine = fine && (now <= kTooLong * 0.5 * (length + patch_.lengths[w]) ||
                      now <= rounded_to_seven_digits((patch_.at(w) - patch_.at(v)).norm()));
    });
    return fine;
  }

  bool triangles_allow(Index v, Index u, const Vector3d& place, bool moves) const {
    ReplacementCheck check(patch_.normal_at(v));
    const auto add_around = [&](Index moved, Index other) {
      net_.for_outgoing(moved, [&](Index h) {
        if (net_.target(h) == other || net_.apex(h) == other) return;
        const auto before = patch_.triangle(h);
        check.add(before, {place, before[1], before[2]});
      });
    };
    add_around(v, u);
    if (moves) add_around(u, v);
    return check.passes() && !folds_when_moved(patch_, place, v, u);
  }

  bool line_allows(Index h, const Vector3d& place, double length, bool moves) const {
    if (!net_.on_line(h)) return true;
    const Index v = net_.origin(h);
    const Index u = net_.target(h);
    const Index line = net_.side(h) / 2;
    return patch_.line_stays_near(line, v, u, place, length) &&
           (!moves || patch_.line_stays_near(line, u, v, place, length));
  }

  WorkingPatch& patch_;
  Halfedges& net_;
  std::priority_queue<ShortEdge> waiting_;
};

}  // namespace

void collapse_short_edges(WorkingPatch& patch) {
  Collapser(patch).run();
}

}  // namespace lapwing::remeshing
