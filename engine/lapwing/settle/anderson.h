#pragma once

#include <span>
#include <vector>

namespace lapwing {

/// Anderson acceleration of a fixed-point iteration x <- G(x) (Walker, Ni 2011): the next x is the
/// combination of the last few G(x) for which the combined residual G(x) - x is smallest. Memory is
/// taken once, 2 (window + 1) vectors.
class Anderson {
 public:
  Anderson(std::size_t size, int window);

  /// Replaces `x` by the next iterate, given g = G(x).
  void advance(std::span<double> x, std::span<const double> g);

  /// Forgets the past; the next `advance` takes g as it is.
  void restart() {
    used_ = 0;
    has_last_ = false;
  }

 private:
  std::span<double> column(std::vector<double>& columns, int k) const {
    return std::span(columns).subspan(static_cast<std::size_t>(k) * size_, size_);
  }

  std::size_t size_;
  int window_;
  int used_ = 0;    ///< differences stored
  int newest_ = 0;  ///< where the next one goes
  bool has_last_ = false;
  std::vector<double> last_g_;
  std::vector<double> last_residual_;
  std::vector<double> g_differences_;
  std::vector<double> residual_differences_;
};

}  // namespace lapwing
