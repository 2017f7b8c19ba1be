#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "fuzz/targets.h"
#include "lapwing/deform/move.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/region/region_spec.h"

namespace lapwing::fuzz {

/// Uses bytes to make choices. When no bytes are left, always makes the first choice.
class Choices {
 public:
  explicit Choices(Bytes bytes) : left_(bytes) {}

  std::uint8_t byte() {
    if (left_.empty()) return 0;
    const std::uint8_t first = left_.front();
    left_ = left_.subspan(1);
    return first;
  }
  bool one_in(unsigned n) { return byte() % n == 1; }
  Index below(Index count) {
    return static_cast<Index>((byte() | static_cast<unsigned>(byte()) << 8U) % count);
  }
  double between(double least, double most) { return least + (most - least) * byte() / 255.0; }
  /// Returns a number near 1, or sometimes a very large or very small one.
  double number() {
    static constexpr std::array kOdd{0.0,   -0.0,  1e-30, 1e30,  1e-300,
                                     1e300, 1e-12, 1e12,  1e154, std::numeric_limits<double>::max(),
                                     5e-324};
    const std::uint8_t which = byte();
    if (which < kOdd.size()) return one_in(2) ? -kOdd[which] : kOdd[which];
    return (which - 133.0) / 61.0;
  }
  /// Returns such a number, but always positive.
  double above_zero() {
    const double x = std::abs(number());
    return x > 0.0 ? x : 1.0;
  }
  Eigen::Vector3d vector() { return {number(), number(), number()}; }

  VertexSet vertices(Index count);
  RegionSpec region(const Mesh& mesh);
  /// Usually returns a disk of some triangles, and rarely an arbitrary region.
  RegionSpec patch(const Mesh& mesh);
  Move move();
  /// Returns a small generated mesh, which sometimes has defects.
  Mesh mesh();

 private:
  Bytes left_;
};

}  // namespace lapwing::fuzz
