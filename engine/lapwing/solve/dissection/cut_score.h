#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace lapwing::dissection {

/// Returns the number of operations to eliminate s unknowns whose rows are dense in these s columns
/// and in b columns eliminated later.
inline double front_operations(double s, double b) {
  return s * (s * s / 3.0 + s * b + b * b);
}

/// Returns the estimated number of operations to eliminate n unknowns of a surface patch whose
/// border has b unknowns, which are eliminated later. This is the sum over the fronts of a nested
/// dissection. The first separator has kSeparator * sqrt(n) unknowns. Each cut halves the unknowns
/// and the border, and adds its separator to the borders of both halves.
inline double patch_operations(double n, double b) {
  constexpr double kSeparator = 3.0;
  const double s = kSeparator * std::sqrt(n);
  return s * (30.37 * s * s + 6.375 * s * b + 1.547 * b * b);
}

/// Sizes of both sides of a cut, in unknowns.
struct SideWeights {
  int of[2] = {0, 0};
  int borders[2] = {0, 0};  ///< number of later unknowns that are coupled with each side

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
  /// Returns the largest allowed weight of a side. The estimated cost of less balanced cuts is
  /// inaccurate.
  int limit() const { return total() - total() / 4; }
  /// Returns true if a node of this weight may leave side `from`: the other side stays within the
  /// limit, or remains lighter than side `from`.
  bool allows(int weight, int from) const {
    const int to = of[1 - from] + weight;
    return to <= limit() || to < of[from];
  }
};

/// The quality of a cut; smaller is better. Compares first by how much a side exceeds the limit,
/// then the estimated operations for both sides and the separator.
class CutScore {
 public:
  /// The score of a missing cut, which is worse than every other score.
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
