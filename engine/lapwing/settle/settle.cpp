// Based on: Sorkine, Cohen-Or, Lipman, Alexa, Roessl, Seidel, "Laplacian Surface Editing", SGP
// 2004, section 3.1; Sorkine, Alexa, "As-Rigid-As-Possible Surface Modeling", SGP 2007; minimized
// after Liu, Bouaziz, Kavan, "Quasi-Newton Methods for Real-Time Simulation of Hyperelastic
// Materials", 2017.
#include "lapwing/settle/settle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"
#include "lapwing/base/parallel.h"
#include "lapwing/base/stopwatch.h"
#include "lapwing/settle/lbfgs.h"
#include "lapwing/settle/moving_part.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

// Steps kept of the past.
constexpr int kWindow = 10;
constexpr std::size_t kUnknownsPerTask = 4096;

// Numbers of iterations.
struct Pace {
  int plain = 0;         // by the n x n factor, before the tangent is worth its factorization
  int tangent = 0;       // by one tangent, before the surface has turned on from it
  int before_parts = 0;  // before what still moves is settled by itself
};
// Chosen on ten scans.
constexpr Pace kPace{10, 5, 5};
// Of a frame, whose history already tells of the pose.
constexpr Pace kPaceOfFrame{50, 5, 25};
// Of all frames together in which the target rests.
constexpr Pace kPaceAtRest{4, 5, 4};
constexpr Pace kPaceOfSmall{0, 2, 0};

constexpr int kIterationsBetweenParts = 2;
// A step is taken where E falls by this share of what its slope promises (Armijo 1966), or rounding
// hides whether it does.
constexpr double kShareOfSlope = 1e-4;
constexpr double kRounding = 1e-13;
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

struct Settler::State {
  const LaplacianSystem& system;
  const RegionRings& rings;
  SettleOptions options;
  double mean_edge;
  std::unique_ptr<RingRotations> rotations;
  TurnedTangent* const given_tangent;
  TurnedTangent* tangent = nullptr;  ///< the same until it could not be turned
  PartSettler* parts;
  Pace pace;
  bool at_rest = false;       ///< whether `pace` is that of frames whose target rests
  int taken = 0;              ///< iterations at this pace
  bool by_tangent = false;    ///< whether directions come from the tangent
  int next_turn = 0;          ///< the iteration before which it is renewed
  int next_part = 0;          ///< and that before which what still moves is settled by itself
  double iteration_ms = 0.0;  ///< of the last one
  Lbfgs history;

  // Vectors over the unknowns, which come in the order of elimination, hold x of all, then y, then
  // z.
  std::vector<Vector3d> displacement;  ///< of RegionRings::vertices
  std::vector<double> energies;        ///< per row
  std::vector<double> scales;          ///< per row
  std::vector<double> weights;         ///< W of each unknown
  std::vector<double> wanted;
  std::vector<double> forces;  ///< none where empty
  std::vector<double> direction;

  // A surface, E there, and half of its gradient.
  struct Point {
    std::vector<double> x;
    std::vector<double> gradient;
    double energy = 0.0;
    double force = 0.0;  ///< |W (x - wanted)|
  };
  Point at;
  Point next;

  // A spring of the system, by rows and by places among the unknowns; kNoIndex for a given corner.
  struct PlacedSpring {
    Spring spring;
    std::array<Index, 3> rows{};
    std::array<Index, 3> places{};
  };
  std::vector<PlacedSpring> springs;

  struct Sums {
    double energy = 0.0;
    double force = 0.0;
    double slope = 0.0;
    double gradient = 0.0;
    double step = 0.0;  ///< the largest
  };
  std::vector<Sums> partial;  ///< per task

  State(Kernels& kernels, const LaplacianSystem& laplacian, const SettleOptions& o,
        TurnedTangent* turned, PartSettler* part_settler)
      : system(laplacian),
        rings(laplacian.rings()),
        options(o),
        mean_edge(mean_length(rings.edges)),
        rotations(kernels.make_ring_rotations(rings)),
        given_tangent(turned),
        parts(part_settler),
        history(3 * laplacian.size(), kWindow),
        displacement(rings.vertices.size(), Vector3d::Zero()),
        energies(rings.row_count()),
        scales(rings.row_count(), 1.0),
        partial((laplacian.size() + kUnknownsPerTask - 1) / kUnknownsPerTask) {
    for (auto* vector : {&wanted, &direction, &at.x, &at.gradient, &next.x, &next.gradient}) {
      vector->resize(3 * system.size());
    }
  }

  void begin_anew();
  void begin_pace(const Pace& of);
  void place(const SettleTarget& target, std::span<const Vector3d> u);
  void read_unknowns(std::span<const Vector3d> u, std::vector<double>& x) const;
  void finish(std::span<Vector3d> u) const;
  void place_springs();
  void evaluate(Point& point);
  Sums pull_by_springs(Point& point) const;
  void turn_tangent();
  void leave_tangent();
  Sums find_direction();
  bool step(double slope);
  bool settle_part(const SettleTarget& asked, double largest, std::span<Vector3d> u,
                   const GoOn& go_on, const Progress& progress);

  Index vertex(std::size_t k) const { return rings.vertices[rings.unknown_rows[k]]; }
  Vector3d of_unknown(std::span<const double> numbers, std::size_t k) const {
    const std::size_t n = system.size();
    return {numbers[k], numbers[n + k], numbers[2 * n + k]};
  }
  // Adds up `add(k, sums)` of every unknown; task by task, so that the result does not depend on
  // the number of threads.
  template <typename Add>
  Sums sum_over_unknowns(const Add& add) {
    parallel_for(partial.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t task = begin; task < end; ++task) {
        Sums& sum = partial[task] = {};
        const std::size_t last = std::min((task + 1) * kUnknownsPerTask, system.size());
        for (std::size_t k = task * kUnknownsPerTask; k < last; ++k) add(k, sum);
      }
    });
    Sums all;
    for (const Sums& sum : partial) {
      all.energy += sum.energy;
      all.force += sum.force;
      all.slope += sum.slope;
      all.gradient += sum.gradient;
      all.step = std::max(all.step, sum.step);
    }
    return all;
  }
};

// As if nothing had been settled before.
void Settler::State::begin_anew() {
  history.forget();
  tangent = given_tangent;
  at_rest = false;
}

void Settler::State::begin_pace(const Pace& of) {
  pace = of;
  at_rest = false;
  taken = 0;
  next_turn = pace.plain;
  next_part = pace.before_parts;
  if (std::exchange(by_tangent, false)) history.forget();
}

// `at` becomes the surface `u`.
void Settler::State::place(const SettleTarget& target, std::span<const Vector3d> u) {
  const std::vector<int>& order = system.elimination_order();
  const std::size_t n = system.size();
  weights.clear();
  for (const int k : order) {
    weights.push_back(system.constraints().W[static_cast<std::size_t>(k)]);
  }
  for (std::size_t r = 0; r < rings.vertices.size(); ++r) {
    displacement[r] = target.wanted[rings.vertices[r]];
  }
  for (std::size_t r = 0; r < rings.row_count(); ++r) {
    scales[r] = target.scales[rings.vertices[r]];
  }
  rotations->set_scales(scales);
  place_springs();
  for (std::size_t k = 0; k < n; ++k) {
    const Index v = vertex(k);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      wanted[axis * n + k] = target.wanted[v][static_cast<Eigen::Index>(axis)];
    }
  }
  forces.resize(target.forces.empty() ? 0 : 3 * n);
  if (!forces.empty()) read_unknowns(target.forces, forces);
  read_unknowns(u, at.x);
  evaluate(at);
}

void Settler::State::read_unknowns(std::span<const Vector3d> u, std::vector<double>& x) const {
  const std::size_t n = system.size();
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      x[axis * n + k] = u[vertex(k)][static_cast<Eigen::Index>(axis)];
    }
  }
}

void Settler::State::place_springs() {
  springs.clear();
  if (system.springs().empty()) return;
  const Unknowns& unknowns = system.constraints().unknowns;
  const std::vector<Index> row_of = places_in(rings.vertices, unknowns.of_vertex.size());
  const std::vector<Index> place_of = places_in(rings.unknown_rows, rings.vertices.size());
  for (const Spring& spring : system.springs()) {
    PlacedSpring& placed = springs.emplace_back(PlacedSpring{spring, {}, {}});
    for (std::size_t c = 0; c < 3; ++c) {
      placed.rows[c] = row_of[spring.corners[c]];
      placed.places[c] = place_of[placed.rows[c]];
    }
  }
}

// Adds to the gradient; returns energy and squared force.
Settler::State::Sums Settler::State::pull_by_springs(Point& point) const {
  const std::size_t n = system.size();
  Sums sum;
  for (const PlacedSpring& placed : springs) {
    const auto& [spring, rows, places] = placed;
    Vector3d off = -spring.wanted;
    for (std::size_t c = 0; c < 3; ++c) off += spring.shares[c] * displacement[rows[c]];
    const Vector3d force = spring.stiffness * off;
    sum.energy += force.dot(off);
    sum.force += force.squaredNorm();
    for (std::size_t c = 0; c < 3; ++c) {
      if (places[c] == kNoIndex) continue;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        point.gradient[axis * n + places[c]] +=
            spring.shares[c] * force[static_cast<Eigen::Index>(axis)];
      }
    }
  }
  return sum;
}

void Settler::State::finish(std::span<Vector3d> u) const {
  for (std::size_t r = 0; r < rings.row_count(); ++r) u[rings.vertices[r]] = displacement[r];
  for (std::size_t k = 0; k < system.size(); ++k) u[vertex(k)] = of_unknown(at.x, k);
}

// Energy and gradient at point.x, with the rotations that are best there.
void Settler::State::evaluate(Point& point) {
  const std::size_t n = system.size();
  parallel_for(n, kUnknownsPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      displacement[rings.unknown_rows[k]] = of_unknown(point.x, k);
    }
  });
  rotations->fit_rotations(displacement, energies);
  rotations->energy_gradient(point.gradient);
  const Sums held = sum_over_unknowns([&](std::size_t k, Sums& sum) {
    for (std::size_t axis = 0; axis < 3 && !forces.empty(); ++axis) {
      const double force = forces[axis * n + k];
      sum.energy -= 2.0 * force * point.x[axis * n + k];
      point.gradient[axis * n + k] -= force;
    }
    if (!(weights[k] > 0.0)) return;
    const Vector3d off = of_unknown(point.x, k) - of_unknown(wanted, k);
    const Vector3d force = weights[k] * off;
    sum.energy += force.dot(off);
    sum.force += force.squaredNorm();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      point.gradient[axis * n + k] += force[static_cast<Eigen::Index>(axis)];
    }
  });
  const Sums drawn = pull_by_springs(point);
  point.force = std::sqrt(held.force + drawn.force);
  point.energy =
      held.energy + drawn.energy +
      Eigen::Map<const Eigen::ArrayXd>(energies.data(), static_cast<Eigen::Index>(energies.size()))
          .sum();
}

// At `at`, where the rotations were fitted last. The history tells what another first Hessian does
// not: it begins anew with each.
void Settler::State::turn_tangent() {
  by_tangent = tangent->turn(rotations->transforms(), displacement);
  if (!by_tangent) tangent = nullptr;
  next_turn = taken + pace.tangent;
  history.forget();
}

// Where the surface is crushed the tangent promises what does not hold.
void Settler::State::leave_tangent() {
  by_tangent = false;
  next_turn = taken + std::max(pace.plain, pace.tangent);
  history.forget();
}

// -direction is where to go; its slope is half that of E, and `step` in mean edge lengths.
Settler::State::Sums Settler::State::find_direction() {
  history.take_changes(at.gradient, direction);
  if (by_tangent) {
    tangent->solve_in_place(direction);
  } else {
    system.solve_in_elimination_order(direction, 3);
  }
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

// Goes from `at` to `next` by as much of the direction as lowers E; false where no
// part does.
bool Settler::State::step(double slope) {
  for (double length = 1.0; length >= kShortestStep;) {
    parallel_for(at.x.size(), 3 * kUnknownsPerTask, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) next.x[i] = at.x[i] - length * direction[i];
    });
    evaluate(next);
    const double promised = 2.0 * length * slope;  // below 0
    const double fall = next.energy - at.energy;
    if (fall <= kShareOfSlope * promised + kRounding * std::abs(at.energy)) return true;
    // The least point of the parabola through what is known.
    const double least = std::isfinite(fall) ? -0.5 * promised / (fall - promised) : 0.0;
    length *= std::clamp(least, 0.1, 0.5);
  }
  return false;
}

// Goes from `at` to `next` by settling what still moves while all else stays; false where that is
// more than a part, or lowers E by no more than rounding.
bool Settler::State::settle_part(const SettleTarget& asked, double largest, std::span<Vector3d> u,
                                 const GoOn& go_on, const Progress& progress) {
  const std::vector<Index> part = moving_part(rings, direction, largest);
  if (part.empty()) return false;
  finish(u);
  parts->settle_part(part, asked, u, go_on, progress);
  read_unknowns(u, next.x);
  evaluate(next);
  if (next.energy < at.energy) return true;
  evaluate(at);
  return false;
}

Settler::Settler(Kernels& kernels, const LaplacianSystem& system, const SettleOptions& options,
                 TurnedTangent* tangent, PartSettler* parts) {
  check(options);
  state_ = std::make_unique<State>(kernels, system, options, tangent, parts);
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
  return iterate(target, u, {}, progress);
}

SettleResult Settler::settle_small(const SettleTarget& target, std::span<Vector3d> u,
                                   const GoOn& go_on, const Progress& progress) {
  state_->begin_anew();
  state_->begin_pace(kPaceOfSmall);
  state_->place(target, u);
  return iterate(target, u, go_on, progress);
}

SettleResult Settler::follow(const SettleTarget& target, std::span<Vector3d> u, const GoOn& go_on,
                             const Progress& progress) {
  state_->begin_pace(kPaceOfFrame);
  state_->place(target, u);
  return iterate(target, u, go_on, progress);
}

SettleResult Settler::rest(const SettleTarget& target, std::span<Vector3d> u, const GoOn& go_on,
                           const Progress& progress) {
  if (!state_->at_rest) state_->begin_pace(kPaceAtRest);
  state_->at_rest = true;
  state_->place(target, u);
  return iterate(target, u, go_on, progress);
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

std::vector<Eigen::Matrix3d> Settler::transforms() const {
  return state_->rotations->transforms();
}

bool Settler::goes_by_tangent() const {
  return state_->by_tangent;
}

// From where `place` has put the unknowns.
SettleResult Settler::iterate(const SettleTarget& target, std::span<Vector3d> u, const GoOn& go_on,
                              const Progress& progress) {
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
      if (s.tangent != nullptr && s.taken >= s.next_turn) {
        // That takes longer than a frame has; the next one begins with it.
        if (s.at_rest && go_on && result.iterations > 0) break;
        s.turn_tangent();
      }
      State::Sums sums = s.find_direction();
      if (!(sums.slope < 0.0) && !history.is_empty()) {
        history.forget();
        sums = s.find_direction();
      }
      result.last_step = sums.step;
      result.relative_gradient = s.at.force > 0.0 ? sums.gradient / s.at.force : 0.0;
      result.settled = sums.step <= s.options.tolerance;
      if (result.settled || result.iterations == s.options.max_iterations) break;

      if (s.parts != nullptr && s.taken >= s.next_part) {
        s.next_part = s.taken + 1 + kIterationsBetweenParts;
        if (s.settle_part(target, sums.step * s.mean_edge, u, go_on, progress)) {
          std::swap(s.at, s.next);
          ++result.iterations;
          ++s.taken;
          continue;
        }
      }
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
      history.add(s.at.x, s.next.x, s.at.gradient, s.next.gradient);
      std::swap(s.at, s.next);
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
