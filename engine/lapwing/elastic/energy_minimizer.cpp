// Based on: Sorkine, Cohen-Or, Lipman, Alexa, Roessl, Seidel, "Laplacian Surface Editing", SGP
// 2004, section 3.1; Sorkine, Alexa, "As-Rigid-As-Possible Surface Modeling", SGP 2007; minimized
// after Liu, Bouaziz, Kavan, "Quasi-Newton Methods for Real-Time Simulation of Hyperelastic
// Materials", 2017.
#include "lapwing/elastic/energy_minimizer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"
#include "lapwing/base/parallel.h"
#include "lapwing/base/stopwatch.h"
#include "lapwing/elastic/energy_minimizer_state.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

// L-BFGS history length, in steps.
constexpr int kHistoryLength = 10;

// Number of iterations before the first factorization of the Hessian, and between factorizations
// (decision 4). For 210 edits of 105 meshes, first factorizations after three and after five
// iterations take the same time within 5%.
constexpr int kBeforeHessian = 3;
constexpr int kHessianPeriod = 20;
constexpr int kNever = std::numeric_limits<int>::max();

void check(const SettleOptions& options) {
  const auto require = [](bool holds, const char* what, double value) {
    if (!holds) throw InputError(std::string(what) + ", not " + std::to_string(value));
  };
  require(options.tolerance > 0.0 && std::isfinite(options.tolerance),
          "the tolerance of settling must be a positive number", options.tolerance);
  require(options.max_iterations >= 1, "settling needs at least one iteration",
          options.max_iterations);
}

double mean_length(std::span<const Vector3d> edges) {
  double sum = 0.0;
  for (const Vector3d& edge : edges) sum += edge.norm();
  return sum > 0.0 ? sum / static_cast<double>(edges.size()) : 1.0;
}

}  // namespace

EnergyMinimizer::State::State(Kernels& kernels, const LaplacianSystem& laplacian,
                              const SettleOptions& o, Preconditioner* hessian)
    : system(laplacian),
      shared_rings(laplacian.shared_rings()),
      options(o),
      mean_edge(mean_length(rings.edges)),
      rotations(kernels.make_ring_rotations(shared_rings)),
      given_preconditioner(hessian),
      history(3 * laplacian.size(), kHistoryLength, mean_edge),
      displacement(rings.vertices.size(), Vector3d::Zero()),
      energies(rings.row_count()),
      prescribed(rings.vertices.size(), Vector3d::Zero()),
      fitted(rings.vertices.size(), Vector3d::Zero()),
      partial((laplacian.size() + kUnknownsPerTask - 1) / kUnknownsPerTask) {
  for (auto* vector : {&direction, &at.x, &at.gradient, &next.x, &next.gradient}) {
    vector->resize(3 * system.size());
  }
}

// Clears the state of earlier minimizations.
void EnergyMinimizer::State::reset_history() {
  history.forget();
  preconditioner = given_preconditioner;
  at_rest = false;
}

// Uses the n x n factor for the first `before_hessian` iterations.
void EnergyMinimizer::State::begin_schedule(int before_hessian) {
  at_rest = false;
  taken = 0;
  next_factorization = before_hessian;
  may_end_by_factor = before_hessian == kNever;
  if (!std::exchange(by_hessian, false)) return;
  history.forget();
  use_factor_for_turns();
}

bool EnergyMinimizer::State::is_hessian_due() const {
  return preconditioner != nullptr && taken >= next_factorization;
}

// Factorizes the Hessian at the pose `at`, at which the rotations were fitted last. The history
// remains valid from one Hessian to the next: both are too stiff in the same directions of
// compression. It is cleared when the Hessian replaces the n x n factor, or the reverse.
void EnergyMinimizer::State::factorize_hessian() {
  const bool had_hessian = by_hessian;
  by_hessian = preconditioner->factorize(rotations->transforms(), displacement);
  if (!by_hessian) preconditioner = nullptr;
  use_factor_for_turns();
  next_factorization = taken + kHessianPeriod;
  if (by_hessian != had_hessian) history.forget();
}

// Uses the n x n factor again, because the Hessian is a poor model of the energy under strong
// compression.
void EnergyMinimizer::State::fall_back_to_factor() {
  by_hessian = false;
  use_factor_for_turns();
  may_end_by_factor = true;
  next_factorization = taken + kHessianPeriod;
  history.forget();
}

// Updates the response of free handles to rotations, which depends on the current preconditioner.
void EnergyMinimizer::State::use_factor_for_turns() {
  for (FreeRotation& rotation : free_rotations) {
    if (by_hessian) {
      rotation.respond_by(
          [this](std::span<double> b) { preconditioner->solve_accurately_in_place(b); });
    } else {
      rotation.respond_by_system();
    }
  }
}

// Computes `direction`; a step moves along -direction. In the result, `slope` is half the slope of
// E, and `step` is in mean edge lengths. `accurate` selects
// Preconditioner::solve_accurately_in_place.
EnergyMinimizer::State::Sums EnergyMinimizer::State::find_direction(bool accurate) {
  history.first_loop(at.gradient, direction);
  for (const FreeRotation& rotation : free_rotations) rotation.rotate_to_factor(direction);
  if (by_hessian && accurate) {
    preconditioner->solve_accurately_in_place(direction);
  } else if (by_hessian) {
    preconditioner->solve_in_place(direction);
  } else {
    system.solve_in_elimination_order(direction, 3);
  }
  for (const FreeRotation& rotation : free_rotations) rotation.add_turn(direction);
  for (const FreeRotation& rotation : free_rotations) rotation.rotate_from_factor(direction);
  history.second_loop(direction);
  Sums sums = sum_over_unknowns([&](std::size_t k, Sums& sum) {
    const Vector3d g = of_unknown(at.gradient, k);
    const Vector3d p = of_unknown(direction, k);
    sum.slope -= g.dot(p);
    sum.gradient += g.squaredNorm();
    sum.step = std::max(sum.step, p.squaredNorm());
  });
  sums.step = std::sqrt(sums.step) / mean_edge;
  sums.gradient = std::sqrt(sums.gradient);
  return sums;
}

// Makes `next` the current point. `next` must have been evaluated last.
void EnergyMinimizer::State::accept_next() {
  std::swap(at, next);
  is_placed = true;
}

// Returns true if the minimization must not end with the current step, because the n x n factor
// computed it. Such a step may be far shorter than the remaining motion of long limbs, so the
// minimization may only end with it if it is nearly 0.
bool EnergyMinimizer::State::must_end_by_hessian() const {
  constexpr double kNextToNothing = 1e-4;
  return !may_end_by_factor && !by_hessian && preconditioner != nullptr &&
         last_step > kNextToNothing * options.tolerance;
}

EnergyMinimizer::EnergyMinimizer(Kernels& kernels, const LaplacianSystem& system,
                                 const SettleOptions& options, Preconditioner* preconditioner) {
  check(options);
  state_ = std::make_unique<State>(kernels, system, options, preconditioner);
}

EnergyMinimizer::~EnergyMinimizer() = default;
EnergyMinimizer::EnergyMinimizer(EnergyMinimizer&&) noexcept = default;
EnergyMinimizer& EnergyMinimizer::operator=(EnergyMinimizer&&) noexcept = default;

double EnergyMinimizer::energy(const MinimizerTarget& target, std::span<const Vector3d> u) {
  state_->place(target, u);
  return state_->at.energy;
}

MinimizerResult EnergyMinimizer::settle(const MinimizerTarget& target, std::span<Vector3d> u,
                                        const Progress& progress) {
  state_->reset_history();
  state_->begin_schedule(kBeforeHessian);
  state_->place(target, u);
  return iterate(u, {}, progress);
}

MinimizerResult EnergyMinimizer::follow(const MinimizerTarget& target, std::span<Vector3d> u,
                                        const TimeBudget& budget, const Progress& progress) {
  state_->begin_schedule(kNever);
  state_->place(target, u);
  return iterate(u, budget, progress);
}

MinimizerResult EnergyMinimizer::follow_by_hessian(const MinimizerTarget& target,
                                                   std::span<Vector3d> u, const TimeBudget& budget,
                                                   const Progress& progress) {
  state_->begin_schedule(0);
  state_->place(target, u);
  return iterate(u, budget, progress);
}

MinimizerResult EnergyMinimizer::follow_at_rest(const MinimizerTarget& target,
                                                std::span<Vector3d> u, const TimeBudget& budget,
                                                const Progress& progress) {
  if (!state_->at_rest) state_->begin_schedule(kBeforeHessian);
  state_->at_rest = true;
  state_->place(target, u);
  return iterate(u, budget, progress);
}

void EnergyMinimizer::end_rest() {
  state_->begin_schedule(kNever);
}

void EnergyMinimizer::begin_drag() {
  state_->reset_history();
}

void EnergyMinimizer::gradient(std::span<Vector3d> gradient) const {
  for (std::size_t k = 0; k < state_->system.size(); ++k) {
    gradient[state_->vertex(k)] = state_->of_unknown(state_->at.gradient, k);
  }
}

std::vector<Eigen::Matrix3d> EnergyMinimizer::transforms() {
  State& s = *state_;
  if (!s.is_placed) s.reevaluate();
  return s.rotations->transforms();
}

std::vector<Eigen::Matrix3d> EnergyMinimizer::handle_rotations() {
  State& s = *state_;
  if (s.free_rotations.empty()) return {};
  if (!s.is_placed) s.reevaluate();
  std::vector<Eigen::Matrix3d> all;
  for (const FreeRotation& rotation : s.free_rotations) all.push_back(rotation.rotation());
  return all;
}

bool EnergyMinimizer::uses_hessian() const {
  return state_->by_hessian;
}

// Minimizes from the point set by `place`.
MinimizerResult EnergyMinimizer::iterate(std::span<Vector3d> u, const TimeBudget& budget,
                                         const Progress& progress) {
  const ProgressScope scope(progress);
  State& s = *state_;
  Lbfgs& history = s.history;
  MinimizerResult result;
  result.settled = s.system.size() == 0;
  Stopwatch watch;
  const auto has_time = [&] {
    if (result.iterations > 0) s.iteration_ms = watch.elapsed_ms();
    watch.restart();
    return !budget || budget(s.iteration_ms);
  };
  try {
    while (!result.settled && has_time()) {
      report_progress(progress, "settle",
                      static_cast<double>(result.iterations) / s.options.max_iterations);
      // After the last iteration, the direction only serves to measure the remaining step.
      const bool is_last = result.iterations == s.options.max_iterations;
      if (!is_last && s.is_hessian_due()) {
        // A factorization takes longer than a frame, so the next frame begins with it.
        if (s.at_rest && budget && result.iterations > 0) break;
        s.factorize_hessian();
        watch.restart();
      }
      State::Sums sums = s.find_direction();
      if (!(sums.slope < 0.0) && !history.is_empty()) {
        history.forget();
        sums = s.find_direction();
      }
      // In single precision, the factor may be too stiff in soft directions; the minimization would
      // then end too early.
      if (s.by_hessian && sums.step <= s.options.tolerance) sums = s.find_direction(true);
      result.last_step = s.last_step = sums.step;
      result.relative_gradient = s.at.force > 0.0 ? sums.gradient / s.at.force : 0.0;
      result.settled = sums.step <= s.options.tolerance;
      if (result.settled && s.must_end_by_hessian()) {
        s.factorize_hessian();
        result.settled = false;
        continue;
      }
      if (result.settled) {
        // The direction is known, so the step costs only one evaluation. It reduces the error far
        // below the tolerance, because remeshing and other discrete operations may depend on small
        // errors. A surface that was already settled does not move.
        if (result.iterations > 0 && s.line_search(sums.slope)) s.accept_next();
        break;
      }
      if (is_last) break;

      if (!s.line_search(sums.slope)) {
        if (!history.is_empty()) {
          history.forget();
        } else if (s.by_hessian) {
          s.fall_back_to_factor();
        } else {
          result.exhausted = true;
          break;
        }
        continue;
      }
      history.add(s.at.x, s.next.x, s.at.gradient, s.next.gradient);
      s.accept_next();
      ++result.iterations;
      ++s.taken;
    }
  } catch (const Cancelled&) {
    s.finish(u);
    throw;
  }
  s.finish(u);
  result.energy = s.at.energy;
  result.lacks_hessian = s.given_preconditioner != nullptr && s.preconditioner == nullptr;
  return result;
}

}  // namespace lapwing
