#pragma once

#include <array>
#include <span>
#include <vector>

#include "lapwing/settle/anderson_loops.h"

namespace lapwing {

/// Anderson acceleration of a fixed-point iteration x <- G(x) (Walker, Ni 2011): the next x is the
/// combination of the last few G(x) for which the combined residual G(x) - x is smallest. Memory is
/// taken once: 2 vectors, and 2 window more in single precision, which is enough for differences;
/// two passes over it each step, on all threads. Same input, same bits.
class Anderson {
 public:
  static constexpr int kLargestWindow = 24;

  Anderson(std::size_t size, int window);

  /// Replaces `x` by the next iterate, given g = G(x). Allocates nothing.
  void advance(std::span<double> x, std::span<const double> g);

  /// Replaces `x` by the g that the last `advance` was given, and forgets the past: for when that
  /// step turns out to lead away.
  void step_back(std::span<double> x);

  /// Keeps what the past tells of G where G itself is now another by a constant; the next `advance`
  /// has no last one to compare with.
  void carry_on() { has_last_ = false; }

  /// Forgets the past; the next `advance` takes g as it is.
  void restart() {
    used_ = newest_ = 0;
    has_last_ = false;
  }

 private:
  using Sums = std::array<double, 2 * kLargestWindow>;

  void take_differences(std::span<const double> x, std::span<const double> g);
  void combine(std::span<double> x, std::span<const double> g, std::span<const double> factors);
  float* column(std::vector<float>& columns, int k) const {
    return columns.data() + static_cast<std::size_t>(k) * size_;
  }

  const AndersonLoops& loops_;
  std::size_t size_;
  int window_;
  int used_ = 0;    ///< differences stored
  int newest_ = 0;  ///< where the next one goes
  bool has_last_ = false;
  std::vector<double> last_g_;
  std::vector<double> last_residual_;
  std::vector<float> g_differences_;
  std::vector<float> residual_differences_;
  std::array<std::array<double, kLargestWindow>, kLargestWindow> products_{};  ///< of differences
  std::array<double, kLargestWindow> with_residual_{};
  std::vector<Sums> partial_;  ///< per chunk of the vectors
};

}  // namespace lapwing
