#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace lapwing::dissection {

/// What it takes to eliminate s unknowns that fill among themselves and with b others, which come
/// later.
inline double front_operations(double s, double b) {
  return s * (s * s / 3.0 + s * b + b * b);
}

/// The same for n unknowns on a surface with a border of b others: the sum over the fronts of a
/// dissection whose first separator holds `kSeparator` sqrt(n). Each cut halves unknowns and
/// border, and adds its separator to the borders of both halves.
inline double patch_operations(double n, double b) {
  constexpr double kSeparator = 3.0;
  const double s = kSeparator * std::sqrt(n);
  return s * (30.37 * s * s + 6.375 * s * b + 1.547 * b * b);
}

/// What both sides of a cut hold, in unknowns.
struct SideWeights {
  int of[2] = {0, 0};
  int borders[2] = {0, 0};  ///< that come later in the order, and fill as these are eliminated

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
  /// What one side may weigh. Beyond it what a cut costs is not estimated well.
  int limit() const { return total() - total() / 4; }
  /// Whether a node may leave side `from`: the other stays within the limit, or the sides become
  /// more equal.
  bool allows(int weight, int from) const {
    const int to = of[1 - from] + weight;
    return to <= limit() || to < of[from];
  }
};

/// How good a cut is: the smaller the better, first by what a side weighs over its limit, then by
/// the operations that both sides and the separator between them will take.
class CutScore {
 public:
  /// Of no cut: worse than that of any.
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
