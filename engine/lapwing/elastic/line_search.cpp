// The line search of EnergyMinimizer: backtracking until Armijo's condition holds.
#include <algorithm>
#include <cmath>

#include "lapwing/elastic/energy_minimizer_state.h"

namespace lapwing {
namespace {

// A step is accepted if E decreases by at least this fraction of the linear prediction (Armijo
// 1966), up to rounding errors.
constexpr double kShareOfSlope = 1e-4;
constexpr double kEnergyRounding = 1e-13;
// The line search fails if the step becomes shorter than this fraction of the full step.
constexpr double kShortestStep = 1e-3;

}  // namespace

// Sets `next` to the surface `at` - `length` * direction.
void EnergyMinimizer::State::go(double length) {
  parallel_for(at.x.size(), 3 * kUnknownsPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) next.x[i] = at.x[i] - length * direction[i];
  });
  for (const FreeRotation& rotation : free_rotations) rotation.bend(length, next.x);
  evaluate(next);
  if (by_hessian) correct();
}

// A step by the Hessian moves vertices along straight lines, which stretches rotating parts, on
// finer meshes more than on coarse ones. One step of the n x n system at the rotations of `next`
// removes that stretch. It never raises E: at fixed rotations, E is a quadratic function with the
// matrix of that system.
void EnergyMinimizer::State::correct() {
  correction = next.gradient;
  system.solve_in_elimination_order(correction, 3);
  parallel_for(next.x.size(), 3 * kUnknownsPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) next.x[i] -= correction[i];
  });
  evaluate(next);
}

// Sets `next` to a surface along the direction at which E is lower. Returns false if there is none.
bool EnergyMinimizer::State::line_search(double slope) {
  for (FreeRotation& rotation : free_rotations) rotation.begin_step(direction);
  for (double length = 1.0; length >= kShortestStep;) {
    go(length);
    const double promised = 2.0 * length * slope;  // predicted change of E, negative
    const double fall = next.energy - at.energy;
    if (fall <= kShareOfSlope * promised + kEnergyRounding * std::abs(at.energy)) {
      return true;
    }
    // The minimum of the interpolating parabola.
    const double least = std::isfinite(fall) ? -0.5 * promised / (fall - promised) : 0.0;
    length *= std::clamp(least, 0.1, 0.5);
  }
  return false;
}

}  // namespace lapwing
