#include "lapwing/remesh/fold_check.h"

#include <algorithm>

#include <Eigen/Geometry>

namespace lapwing::remeshing {
namespace {

using Eigen::Vector3d;

// Smallest allowed cosines. At first, edges that are not on lines are not sharper than the feature
// angle; coarse triangles on a small ball meet at 41 degrees. Lines are mostly edges of boxes.
constexpr double kSharpestCosine = 0.3;
constexpr double kSharpestLineCosine = -0.2;

class Motion {
 public:
  Motion(const WorkingPatch& patch, const Vector3d& place, Index v, Index into)
      : patch_(patch), net_(patch.net), place_(place), moved_{v, into} {}

  bool folds() const {
    return is_new_fold(sharpest([&](Index e) { return margin_before(e); }),
                       sharpest([&](Index e) { return margin_after(e); }));
  }

 private:
  // Returns the smallest margin over the edges of the triangles around the moved vertices.
  template <class Margin>
  double sharpest(const Margin& margin) const {
    double least = 1.0;
    for (const Index v : moved_) {
      if (v == kNoIndex) continue;
      net_.for_outgoing(v, [&](Index h) {
        least = std::min({least, margin(h), margin(Halfedges::next(h))});
      });
    }
    return least;
  }

  bool vanishes(Index h) const {
    const auto is_moved = [&](Index v) { return v == moved_[0] || v == moved_[1]; };
    return is_moved(net_.origin(h)) + is_moved(net_.target(h)) + is_moved(net_.apex(h)) > 1;
  }

  double margin_before(Index h) const {
    if (net_.twin(h) == kNoIndex) return 1.0;
    return fold_margin(area_before(h), area_before(net_.twin(h)), net_.on_line(h));
  }

  // If a triangle vanishes, its other two edges are merged.
  double margin_after(Index h) const {
    Index other = net_.twin(h);
    if (vanishes(h) || other == kNoIndex) return 1.0;
    bool on_line = net_.on_line(h);
    if (vanishes(other)) {
      const Index following = Halfedges::next(other);
      const bool edge_is_next = moves_along(following);
      other = edge_is_next ? Halfedges::previous(other) : following;
      on_line = on_line || net_.on_line(other);
      other = net_.twin(other);
      if (other == kNoIndex || vanishes(other)) return 1.0;
    }
    return fold_margin(area_after(h), area_after(other), on_line);
  }

  // Returns whether `h` is the edge between the two vertices that are merged.
  bool moves_along(Index h) const {
    const Index a = net_.origin(h);
    const Index b = net_.target(h);
    return (a == moved_[0] && b == moved_[1]) || (a == moved_[1] && b == moved_[0]);
  }

  Vector3d area_before(Index h) const {
    const auto [a, b, c] = patch_.triangle(h);
    return (b - a).cross(c - a);
  }

  Vector3d after(Index v) const { return v == moved_[0] || v == moved_[1] ? place_ : patch_.at(v); }

  Vector3d area_after(Index h) const {
    const Vector3d a = after(net_.origin(h));
    return (after(net_.target(h)) - a).cross(after(net_.apex(h)) - a);
  }

  const WorkingPatch& patch_;
  const Halfedges& net_;
  const Vector3d& place_;
  std::array<Index, 2> moved_;
};

}  // namespace

bool is_new_fold(double before, double after) {
  return after < std::min(0.0, before - kSameQuality);
}

double fold_margin(const Vector3d& a, const Vector3d& b, bool on_line) {
  const double scale = a.norm() * b.norm();
  if (scale == 0.0) return 1.0;
  return a.dot(b) / scale - (on_line ? kSharpestLineCosine : kSharpestCosine);
}

bool folds_when_moved(const WorkingPatch& patch, const Vector3d& place, Index v, Index into) {
  return Motion(patch, place, v, into).folds();
}

}  // namespace lapwing::remeshing
