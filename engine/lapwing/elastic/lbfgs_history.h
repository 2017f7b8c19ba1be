#pragma once

#include <array>
#include <span>
#include <vector>

#include "lapwing/elastic/history_loops.h"

namespace lapwing {

/// The history of limited-memory BFGS (Nocedal 1980). If A is the first Hessian, which the caller
/// has factorized, then
///     history.first_loop(g, p);  // p from the gradient g
///     p = A^-1 p;
///     history.second_loop(p);
/// sets p to g multiplied by the inverse of an improved Hessian. Stores 2 * `window` vectors in
/// single precision. They are divided by `length`, the approximate length of a step, so that they
/// do not leave the range of floats. Results do not depend on the number of threads.
class Lbfgs {
 public:
  static constexpr int kLargestWindow = 24;

  Lbfgs(std::size_t size, int window, double length = 1.0);

  /// Adds the step from `last_x` to `x`, along which the gradient changed from `last_g` to `g`. If
  /// the history is full, the step replaces the oldest one. A step without positive curvature is
  /// not added.
  void add(std::span<const double> last_x, std::span<const double> x,
           std::span<const double> last_g, std::span<const double> g);

  /// The first half of the two-loop recursion: sets p to g minus multiples of the gradient changes.
  void first_loop(std::span<const double> g, std::span<double> p);
  /// The second half of the two-loop recursion: adds multiples of the steps to p.
  void second_loop(std::span<double> p);

  bool is_empty() const { return used_ == 0; }
  void forget() { used_ = newest_ = 0; }

 private:
  // Dot products over one chunk: for each slot of the history, and squares of the newest step and
  // change.
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
  double scale_;  ///< of the stored vectors; a power of two, so that scaling is exact
  int used_ = 0;
  int newest_ = 0;  ///< slot of the newest step
  std::vector<float> steps_;
  std::vector<float> changes_;
  /// Dot products of steps and changes.
  std::array<std::array<double, kLargestWindow>, kLargestWindow> products_{};
  /// Per slot: of the changes in the first loop, of the steps in the second.
  std::array<double, kLargestWindow> factors_{};
  std::vector<Sums> partial_;  ///< per chunk of the vectors
};

}  // namespace lapwing
