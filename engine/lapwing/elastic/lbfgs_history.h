#pragma once

#include <array>
#include <span>
#include <vector>

#include "lapwing/elastic/history_loops.h"

namespace lapwing {

/// The history of limited-memory BFGS (Nocedal 1980). With A the first Hessian, whose factor the
/// caller has,
///     history.first_loop(g, p);  // p from the gradient g
///     p = A^-1 p;
///     history.second_loop(p);
/// sets p to the inverse of a better Hessian times g. Stores 2 `window` vectors in single
/// precision, scaled by `length`, about that of a step, to keep them in range. Results do not
/// depend on the number of threads.
class Lbfgs {
 public:
  static constexpr int kLargestWindow = 24;

  Lbfgs(std::size_t size, int window, double length = 1.0);

  /// Adds the step from `last_x` to `x`, along which the gradient went from `last_g` to `g`, in
  /// place of the oldest one. A step along which the gradient did not grow is left out.
  void add(std::span<const double> last_x, std::span<const double> x,
           std::span<const double> last_g, std::span<const double> g);

  /// The first half of the two-loop recursion: p is g without its parts along gradient changes.
  void first_loop(std::span<const double> g, std::span<double> p);
  /// The second half: adds the steps.
  void second_loop(std::span<double> p);

  bool is_empty() const { return used_ == 0; }
  void forget() { used_ = newest_ = 0; }

 private:
  // Dot products over one chunk, per slot of the history, and squares for the newest step.
  struct Sums {
    std::array<double, kLargestWindow> first{};
    std::array<double, kLargestWindow> second{};
    double step_square = 0.0;
    double change_square = 0.0;

    void operator+=(const Sums& other);
  };

  // Returns the slot of the k-th newest step; 0 is the newest.
  std::size_t slot(int k) const {
    return static_cast<std::size_t>((newest_ - k + window_) % window_);
  }
  float* at(std::vector<float>& columns, std::size_t slot) const {
    return columns.data() + slot * size_;
  }
  Sums sum_of_chunks() const;
  void combine(std::span<double> x, std::vector<float>& columns);

  const HistoryLoops& loops_;
  std::size_t size_;
  int window_;
  double scale_;  ///< of the stored vectors: a power of two, so exact
  int used_ = 0;
  int newest_ = 0;  ///< slot of the last one stored
  std::vector<float> steps_;
  std::vector<float> changes_;
  std::array<std::array<double, kLargestWindow>, kLargestWindow> products_{};  ///< step . change
  std::array<double, kLargestWindow> factors_{};  ///< of the changes, then of the steps; per slot
  std::vector<Sums> partial_;                     ///< per chunk of the vectors
};

}  // namespace lapwing
