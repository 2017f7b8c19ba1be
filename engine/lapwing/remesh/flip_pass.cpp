#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/base/cancellation.h"
#include "lapwing/remesh/fold_check.h"
#include "lapwing/remesh/passes.h"

namespace lapwing::remeshing {
namespace {

using Eigen::Vector3d;
using Corners = std::array<Vector3d, 3>;

constexpr int kMostRounds = 8;

double angle_at(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
  const Vector3d x = a - p;
  const Vector3d y = b - p;
  return std::atan2(x.cross(y).norm(), x.dot(y));
}

Vector3d area(const Corners& t) {
  return (t[1] - t[0]).cross(t[2] - t[0]);
}

double smallest_corner(const Corners& t) {
  return std::min(
      {angle_at(t[0], t[1], t[2]), angle_at(t[1], t[2], t[0]), angle_at(t[2], t[0], t[1])});
}

// The two triangles at an edge from v to u with the apexes a and b: above and below before the
// flip, left and right after it.
struct Quad {
  Index v, u, a, b;
  Corners above, below, left, right;

  Quad(const WorkingPatch& patch, Index h)
      : v(patch.net.origin(h)),
        u(patch.net.target(h)),
        a(patch.net.apex(h)),
        b(patch.net.apex(patch.net.twin(h))),
        above{patch.at(v), patch.at(u), patch.at(a)},
        below{patch.at(u), patch.at(v), patch.at(b)},
        left{patch.at(b), patch.at(a), patch.at(v)},
        right{patch.at(a), patch.at(b), patch.at(u)} {}
};

class Flipper {
 public:
  explicit Flipper(WorkingPatch& patch) : patch_(patch), net_(patch.net) {}

  // Flips until no flip is better. Stops after kMostRounds, because flips on a curved surface might
  // cycle.
  template <class IsBetter>
  void run(const IsBetter& is_better) {
    for (int round = 0; round < kMostRounds; ++round) {
      bool flipped = false;
      CancelCheck cancel_check;
      for (Index h = 0; h < net_.halfedge_count(); ++h) {
        cancel_check();
        if (!net_.is_alive(h) || net_.twin(h) == kNoIndex || net_.twin(h) < h) continue;
        if (net_.on_line(h)) continue;
        const Quad quad(patch_, h);
        if (!is_better(quad) || !may_flip(h, quad)) continue;
        net_.flip(h);
        flipped = true;
        count(quad);
      }
      if (!flipped) break;
    }
  }

  void count_valences() {
    surplus_.assign(net_.vertex_count(), 0);
    CancelCheck cancel_check;
    for (Index v = 0; v < net_.vertex_count(); ++v) {
      cancel_check();
      if (net_.has_vertex(v)) surplus_[v] = net_.valence(v) - wanted_valence(v);
    }
  }

  // Returns the decrease, by a flip, of the sum of squared deviations from the wanted valences.
  int valence_gain(const Quad& quad) const {
    const auto square = [](int x) { return x * x; };
    int gain = 0;
    for (const Index v : {quad.v, quad.u}) gain += square(surplus_[v]) - square(surplus_[v] - 1);
    for (const Index v : {quad.a, quad.b}) gain += square(surplus_[v]) - square(surplus_[v] + 1);
    return gain;
  }

 private:
  int wanted_valence(Index v) const {
    if (patch_.kinds[v] != VertexKind::fixed) return 6;
    double sum = 0.0;
    net_.for_outgoing(v, [&](Index h) {
      sum += angle_at(patch_.at(v), patch_.at(net_.target(h)), patch_.at(net_.apex(h)));
    });
    const auto triangles = static_cast<int>(std::lround(sum / (std::numbers::pi / 3.0)));
    return net_.is_border_vertex(v) ? std::max(1, triangles) + 1 : std::max(3, triangles);
  }

  void count(const Quad& quad) {
    if (surplus_.empty()) return;
    for (const Index v : {quad.v, quad.u}) --surplus_[v];
    for (const Index v : {quad.a, quad.b}) ++surplus_[v];
  }

  bool may_flip(Index h, const Quad& quad) const {
    ReplacementCheck check(area(quad.above) + area(quad.below));
    for (const Corners& was : {quad.above, quad.below}) {
      check.add(was, quad.left);
      check.add(was, quad.right);
    }
    for (const Index v : {quad.v, quad.u}) {
      if (net_.valence(v) <= (net_.is_border_vertex(v) ? 2 : 3)) return false;
    }
    return check.passes() && !folds(h, quad) && !patch_.is_same(quad.a, quad.b) &&
           !patch_.are_joined(quad.a, quad.b);
  }

  // Returns whether the new edge or one of the four edges around it becomes sharper than allowed,
  // and sharper than all five edges were before.
  bool folds(Index h, const Quad& quad) const {
    const Vector3d above = area(quad.above);
    const Vector3d below = area(quad.below);
    const Vector3d left = area(quad.left);
    const Vector3d right = area(quad.right);
    double before = fold_margin(above, below, false);
    double after = fold_margin(left, right, false);
    const auto compare = [&](Index e, const Vector3d& was, const Vector3d& is) {
      if (net_.twin(e) == kNoIndex) return;
      const Vector3d other = area(patch_.triangle(net_.twin(e)));
      before = std::min(before, fold_margin(other, was, net_.on_line(e)));
      after = std::min(after, fold_margin(other, is, net_.on_line(e)));
    };
    const Index k = net_.twin(h);
    compare(Halfedges::next(h), above, right);
    compare(Halfedges::previous(h), above, left);
    compare(Halfedges::next(k), below, left);
    compare(Halfedges::previous(k), below, right);
    return is_new_fold(before, after);
  }

  WorkingPatch& patch_;
  Halfedges& net_;
  std::vector<int> surplus_;  // per vertex: valence minus wanted valence
};

}  // namespace

void flip_for_valence(WorkingPatch& patch) {
  Flipper flipper(patch);
  flipper.count_valences();
  flipper.run([&](const Quad& quad) { return flipper.valence_gain(quad) > 0; });
}

void flip_for_angles(WorkingPatch& patch) {
  Flipper(patch).run([](const Quad& quad) {
    const double before = std::min(smallest_corner(quad.above), smallest_corner(quad.below));
    const double after = std::min(smallest_corner(quad.left), smallest_corner(quad.right));
    return after > before + kSameQuality;
  });
}

}  // namespace lapwing::remeshing
