#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace lapwing::dissection {

/// Returns the operations to eliminate s unknowns that fill in among themselves and with b later
/// ones.
inline double front_operations(double s, double b) {
  return s * (s * s / 3.0 + s * b + b * b);
}

/// Returns the same for n unknowns on a surface with a border of b others. Sums over the fronts of
/// a dissection whose first separator holds `kSeparator` sqrt(n). Each cut halves unknowns and
/// border, and adds its separator to the borders of both halves.
inline double patch_operations(double n, double b) {
  constexpr double kSeparator = 3.0;
  const double s = kSeparator * std::sqrt(n);
  return s * (30.37 * s * s + 6.375 * s * b + 1.547 * b * b);
}

/// Sizes of both sides of a cut, in unknowns.
struct SideWeights {
  int of[2] = {0, 0};
  int borders[2] = {0, 0};  ///< later unknowns that fill in as each side is eliminated

  int total() const { return of[0] + of[1]; }
  void add(int weight, int border, int to) {
    of[to] += weight;
    borders[to] += border;
  }
  void move(int weight, int border, int from) {
    add(-weight, -border, from);
    add(weight, border, 1 - from);
  }
  int heavier() const { return std::max(of[0], of[1]); }
  /// Returns the largest weight of a side. Beyond it, the cost of a cut is estimated badly.
  int limit() const { return total() - total() / 4; }
  /// Returns true if a node may leave side `from`: the other side stays within the limit, or the
  /// sides become more equal.
  bool allows(int weight, int from) const {
    const int to = of[1 - from] + weight;
    return to <= limit() || to < of[from];
  }
};

/// The quality of a cut; smaller is better. Compares first how far a side exceeds its limit, then
/// the operations for both sides and the separator.
class CutScore {
 public:
  /// The score of no cut, worse than that of any.
  CutScore() : over_(std::numeric_limits<int>::max()) {}
  CutScore(const SideWeights& sides, int separator)
      : over_(std::max(0, sides.heavier() - sides.limit())) {
    cost_ = front_operations(separator, sides.borders[0] + sides.borders[1]);
    for (const int side : {0, 1}) {
      cost_ += patch_operations(sides.of[side], sides.borders[side] + separator);
    }
  }
  friend bool operator<(const CutScore& a, const CutScore& b) {
    return std::tie(a.over_, a.cost_) < std::tie(b.over_, b.cost_);
  }

 private:
  int over_;
  double cost_ = 0;
};

}  // namespace lapwing::dissection
