// Based on: Sorkine, Cohen-Or, Lipman, Alexa, Roessl, Seidel, "Laplacian Surface Editing", SGP
// 2004, section 3.1; Sorkine, Alexa, "As-Rigid-As-Possible Surface Modeling", SGP 2007; minimized
// after Liu, Bouaziz, Kavan, "Quasi-Newton Methods for Real-Time Simulation of Hyperelastic
// Materials", 2017.
#include "lapwing/settle/settle.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"
#include "lapwing/base/parallel.h"
#include "lapwing/base/stopwatch.h"
#include "lapwing/settle/settler_state.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

// Steps kept of the past.
constexpr int kWindow = 10;

// By the n x n factor, and then by each Hessian. Refactoring every fifth or every third iteration
// takes the same time on 26 edits of 13 meshes.
constexpr SettlePace kPace{.plain = 5, .tangent = 5, .ends_plain = false};
// Of a frame, whose history already tells of the pose.
constexpr SettlePace kPaceOfFrame{50, 5};
// Of all frames together in which the target rests.
constexpr SettlePace kPaceAtRest{4, 5, 12};

// Steps of plain iterations that are long, in mean edge lengths.
constexpr double kLongStep = 0.03;
// A step is taken where E falls by this share of what its slope promises (Armijo 1966), or rounding
// hides whether it does.
constexpr double kShareOfSlope = 1e-4;
constexpr double kRounding = 1e-13;
// If a full step by the Hessian of the pose lowers E by more than this share of what its slope
// promises, the minimum along it is at least a quarter farther. Extending the step, up to
// kLongestStep times, saves up to a third of the iterations where limbs swing far (`armadillo`,
// whole and one arm, with and without free handles). With the n x n factor most steps are like
// this, and the extra evaluations save nothing.
constexpr double kNearlyStraight = 0.6;
constexpr double kLongestStep = 8.0;
// Iterations between factorizations of the Hessian with free handles. L-BFGS keeps no history then,
// since steps at one rotation do not describe the energy at another.
constexpr int kIterationsOfFreeHandles = 3;
// Steps this much shorter than asked for are none.
constexpr double kShortestStep = 1e-3;

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

Settler::State::State(Kernels& kernels, const LaplacianSystem& laplacian, const SettleOptions& o,
                      TurnedTangent* turned)
    : system(laplacian),
      shared_rings(laplacian.shared_rings()),
      options(o),
      mean_edge(mean_length(rings.edges)),
      rotations(kernels.make_ring_rotations(shared_rings)),
      given_tangent(turned),
      history(3 * laplacian.size(), kWindow, mean_edge),
      displacement(rings.vertices.size(), Vector3d::Zero()),
      energies(rings.row_count()),
      given(rings.vertices.size(), Vector3d::Zero()),
      wanted(rings.vertices.size(), Vector3d::Zero()),
      partial((laplacian.size() + kUnknownsPerTask - 1) / kUnknownsPerTask) {
  for (auto* vector : {&direction, &at.x, &at.gradient, &next.x, &next.gradient}) {
    vector->resize(3 * system.size());
  }
}

// As if nothing had been settled before.
void Settler::State::begin_anew() {
  history.forget();
  tangent = given_tangent;
  at_rest = false;
}

void Settler::State::begin_pace(const SettlePace& of) {
  pace = of;
  at_rest = false;
  taken = 0;
  next_turn = pace.plain;
  if (!std::exchange(by_tangent, false)) return;
  history.forget();
  use_factor_for_turns();
}

bool Settler::State::is_turn_due() const {
  if (tangent == nullptr || taken < next_turn) return false;
  return by_tangent || taken >= pace.most_plain || last_step <= kLongStep;
}

// At `at`, where the rotations were fitted last. The history tells what its first Hessian does not,
// and begins anew with another kind of one. What one tangent does not tell the next does not
// either: directions of compression, in which the energy is softer than any tangent.
void Settler::State::turn_tangent() {
  const bool had_tangent = by_tangent;
  by_tangent = tangent->turn(rotations->transforms(), displacement);
  if (!by_tangent) tangent = nullptr;
  use_factor_for_turns();
  next_turn = taken + (free_rotations.empty() ? pace.tangent : kIterationsOfFreeHandles);
  if (by_tangent != had_tangent) history.forget();
}

// Where the surface is crushed the tangent promises what does not hold.
void Settler::State::leave_tangent() {
  by_tangent = false;
  use_factor_for_turns();
  pace.ends_plain = true;
  next_turn = taken + std::max(pace.plain, pace.tangent);
  history.forget();
}

// The response of free handles to a turn depends on the matrix that directions come from.
void Settler::State::use_factor_for_turns() {
  for (FreeRotation& rotation : free_rotations) {
    if (by_tangent) {
      rotation.respond_by([this](std::span<double> b) { tangent->solve_well_in_place(b); });
    } else {
      rotation.respond_by_system();
    }
  }
}

// -direction is where to go; its slope is half that of E, and `step` in mean edge lengths. `well`
// is as solve_well_in_place has it.
Settler::State::Sums Settler::State::find_direction(bool well) {
  history.take_changes(at.gradient, direction);
  for (const FreeRotation& rotation : free_rotations) rotation.enter_frame(direction);
  if (by_tangent && well) {
    tangent->solve_well_in_place(direction);
  } else if (by_tangent) {
    tangent->solve_in_place(direction);
  } else {
    system.solve_in_elimination_order(direction, 3);
  }
  for (const FreeRotation& rotation : free_rotations) rotation.add_turn(direction);
  for (const FreeRotation& rotation : free_rotations) rotation.leave_frame(direction);
  history.add_steps(direction);
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

// `next` becomes the surface that is so much of the direction away from `at`.
void Settler::State::go(double length) {
  parallel_for(at.x.size(), 3 * kUnknownsPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) next.x[i] = at.x[i] - length * direction[i];
  });
  for (const FreeRotation& rotation : free_rotations) rotation.bend(length, next.x);
  evaluate(next);
}

// Goes from `at` to `next` by as much of the direction as lowers E; false where no
// part does.
bool Settler::State::step(double slope) {
  for (FreeRotation& rotation : free_rotations) rotation.begin_step(direction);
  for (double length = 1.0; length >= kShortestStep;) {
    go(length);
    const double promised = 2.0 * length * slope;  // below 0
    const double fall = next.energy - at.energy;
    if (fall <= kShareOfSlope * promised + kRounding * std::abs(at.energy)) {
      const bool is_full = by_tangent && length == 1.0;
      if (is_full && fall < kNearlyStraight * promised) go_farther(fall / promised);
      return true;
    }
    // The least point of the parabola through what is known.
    const double least = std::isfinite(fall) ? -0.5 * promised / (fall - promised) : 0.0;
    length *= std::clamp(least, 0.1, 0.5);
  }
  return false;
}

// A full step has lowered E by `share` of what its slope promises.
void Settler::State::go_farther(double share) {
  const double energy = next.energy;
  go(std::min(0.5 / std::max(1.0 - share, 0.5 / kLongestStep), kLongestStep));
  if (!(next.energy < energy)) go(1.0);
}

// After `next` was evaluated.
void Settler::State::take_next() {
  std::swap(at, next);
  is_placed = true;
}

// Whether settling would end by a plain step, which may be far shorter than the way that long parts
// have left to bend. A step that is next to nothing may be what it ends by.
bool Settler::State::must_turn_to_end() const {
  constexpr double kNextToNothing = 1e-4;
  return !pace.ends_plain && !by_tangent && tangent != nullptr &&
         last_step > kNextToNothing * options.tolerance;
}

Settler::Settler(Kernels& kernels, const LaplacianSystem& system, const SettleOptions& options,
                 TurnedTangent* tangent) {
  check(options);
  state_ = std::make_unique<State>(kernels, system, options, tangent);
}

Settler::~Settler() = default;
Settler::Settler(Settler&&) noexcept = default;
Settler& Settler::operator=(Settler&&) noexcept = default;

double Settler::energy(const SettleTarget& target, std::span<const Vector3d> u) {
  state_->place(target, u);
  return state_->at.energy;
}

SettleResult Settler::settle(const SettleTarget& target, std::span<Vector3d> u,
                             const Progress& progress) {
  state_->begin_anew();
  state_->begin_pace(kPace);
  state_->place(target, u);
  return iterate(u, {}, progress);
}

SettleResult Settler::follow(const SettleTarget& target, std::span<Vector3d> u, const GoOn& go_on,
                             const Progress& progress) {
  state_->begin_pace(kPaceOfFrame);
  state_->place(target, u);
  return iterate(u, go_on, progress);
}

SettleResult Settler::rest(const SettleTarget& target, std::span<Vector3d> u, const GoOn& go_on,
                           const Progress& progress) {
  if (!state_->at_rest) state_->begin_pace(kPaceAtRest);
  state_->at_rest = true;
  state_->place(target, u);
  return iterate(u, go_on, progress);
}

void Settler::end_rest() {
  state_->begin_pace(kPaceOfFrame);
}

void Settler::begin_drag() {
  state_->begin_anew();
}

void Settler::gradient(std::span<Vector3d> gradient) const {
  for (std::size_t k = 0; k < state_->system.size(); ++k) {
    gradient[state_->vertex(k)] = state_->of_unknown(state_->at.gradient, k);
  }
}

std::vector<Eigen::Matrix3d> Settler::transforms() {
  State& s = *state_;
  if (!s.is_placed) s.place_again();
  return s.rotations->transforms();
}

std::vector<Eigen::Matrix3d> Settler::handle_rotations() {
  State& s = *state_;
  if (s.free_rotations.empty()) return {};
  if (!s.is_placed) s.place_again();
  std::vector<Eigen::Matrix3d> all;
  for (const FreeRotation& rotation : s.free_rotations) all.push_back(rotation.rotation());
  return all;
}

bool Settler::goes_by_tangent() const {
  return state_->by_tangent;
}

// From where `place` has put the unknowns.
SettleResult Settler::iterate(std::span<Vector3d> u, const GoOn& go_on, const Progress& progress) {
  const ProgressScope scope(progress);
  State& s = *state_;
  Lbfgs& history = s.history;
  SettleResult result;
  result.settled = s.system.size() == 0;
  Stopwatch watch;
  const auto may_go_on = [&] {
    if (result.iterations > 0) s.iteration_ms = watch.elapsed_ms();
    watch.restart();
    return !go_on || go_on(s.iteration_ms);
  };
  try {
    while (!result.settled && may_go_on()) {
      report_progress(progress, "settle",
                      static_cast<double>(result.iterations) / s.options.max_iterations);
      if (s.is_turn_due()) {
        // That takes longer than a frame has; the next one begins with it.
        if (s.at_rest && go_on && result.iterations > 0) break;
        s.turn_tangent();
        watch.restart();
      }
      State::Sums sums = s.find_direction();
      if (!(sums.slope < 0.0) && !history.is_empty()) {
        history.forget();
        sums = s.find_direction();
      }
      // A factor that is not exact may be too stiff where the surface is soft, and end too early.
      if (s.by_tangent && sums.step <= s.options.tolerance) sums = s.find_direction(true);
      result.last_step = s.last_step = sums.step;
      result.relative_gradient = s.at.force > 0.0 ? sums.gradient / s.at.force : 0.0;
      result.settled = sums.step <= s.options.tolerance;
      if (result.settled && s.must_turn_to_end()) {
        s.turn_tangent();
        result.settled = false;
        continue;
      }
      if (result.settled) {
        // The direction is known, so taking it costs one evaluation and leaves an error far below
        // the tolerance, on which remeshing and other discrete steps may depend. A surface that was
        // settled before stays where it is.
        if (result.iterations > 0 && s.step(sums.slope)) s.take_next();
        break;
      }
      if (result.iterations == s.options.max_iterations) break;

      if (!s.step(sums.slope)) {
        if (!history.is_empty()) {
          history.forget();
        } else if (s.by_tangent) {
          s.leave_tangent();
        } else {
          result.exhausted = true;
          break;
        }
        continue;
      }
      if (!s.by_tangent || s.free_rotations.empty()) {
        history.add(s.at.x, s.next.x, s.at.gradient, s.next.gradient);
      }
      s.take_next();
      ++result.iterations;
      ++s.taken;
    }
  } catch (const Cancelled&) {
    s.finish(u);
    throw;
  }
  s.finish(u);
  result.energy = s.at.energy;
  return result;
}

}  // namespace lapwing
