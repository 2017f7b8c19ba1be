// Based on: Sorkine, Cohen-Or, Lipman, Alexa, Roessl, Seidel, "Laplacian Surface Editing", SGP
// 2004, section 3.1, alternated as in Sorkine, Alexa, "As-Rigid-As-Possible Surface Modeling", SGP
// 2007; accelerated after Peng et al., "Anderson Acceleration for Geometry Optimization", 2018.
#include "lapwing/settle/settle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "lapwing/base/errors.h"
#include "lapwing/base/parallel.h"
#include "lapwing/settle/anderson.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

// The harder the motion, the more a longer memory saves.
constexpr int kWindow = 8;
constexpr int kFollowingWindow = 24;
constexpr std::size_t kUnknownsPerTask = 4096;

void check(const SettleOptions& options) {
  const auto require = [](bool holds, const char* what, double value) {
    if (!holds) throw InputError(std::string(what) + ", not " + std::to_string(value));
  };
  require(options.tolerance > 0.0 && std::isfinite(options.tolerance),
          "the tolerance of settling must be a positive number", options.tolerance);
  require(options.stretch_resistance >= 0.0 && std::isfinite(options.stretch_resistance),
          "the stretch resistance must be 0 or more", options.stretch_resistance);
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
  Anderson anderson;
  std::optional<Anderson> following;  ///< from the first frame on

  // Of one iteration. Vectors over the unknowns, which come in the order of elimination, hold x of
  // all, then y, then z.
  std::vector<Vector3d> displacement;  ///< of RegionRings::vertices
  std::vector<double> energies;        ///< per row
  std::vector<double> weights;         ///< W of each unknown
  std::vector<double> wanted;          ///< over the unknowns
  std::vector<double> constant;        ///< what wanted positions add to the right-hand side
  std::vector<double> x;               ///< where the unknowns are
  std::vector<double> g;               ///< right-hand side, then where one global step takes them

  struct Measures {
    double residual = 0.0;      ///< |g - x|
    double largest_step = 0.0;  ///< of a vertex, in mean edge lengths
    double energy = 0.0;
  };
  std::vector<Measures> partial;  ///< per task, of squares

  State(Kernels& kernels, const LaplacianSystem& laplacian, const SettleOptions& o)
      : system(laplacian),
        rings(laplacian.rings()),
        options(o),
        mean_edge(mean_length(rings.edges)),
        rotations(kernels.make_ring_rotations(
            rings, o.details == Details::follow ? RingMotion::similarity : RingMotion::rotation)),
        anderson(3 * laplacian.size(), kWindow),
        displacement(rings.vertices.size(), Vector3d::Zero()),
        energies(rings.row_count()),
        partial((laplacian.size() + kUnknownsPerTask - 1) / kUnknownsPerTask) {
    for (auto* vector : {&wanted, &constant, &x, &g}) vector->resize(3 * system.size());
    for (const int k : system.elimination_order()) {
      weights.push_back(system.constraints().W[static_cast<std::size_t>(k)]);
    }
  }

  void begin(std::span<const Vector3d> handles, std::span<const Vector3d> u);
  void finish(std::span<const double> from, std::span<Vector3d> u) const;
  void fit_rotations(std::span<const double> from);
  void global_step();
  Measures measure();

  Index vertex(std::size_t k) const { return rings.vertices[rings.unknown_rows[k]]; }
  Vector3d of_unknown(std::span<const double> numbers, std::size_t k) const {
    const std::size_t n = system.size();
    return {numbers[k], numbers[n + k], numbers[2 * n + k]};
  }
};

void Settler::State::begin(std::span<const Vector3d> handles, std::span<const Vector3d> u) {
  const std::vector<int>& order = system.elimination_order();
  const std::size_t n = system.size();
  system.right_hand_side(handles, g);
  for (std::size_t r = 0; r < rings.row_count(); ++r) displacement[r] = handles[rings.vertices[r]];
  for (std::size_t k = 0; k < n; ++k) {
    const Index v = vertex(k);
    const auto own = static_cast<std::size_t>(order[k]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      wanted[axis * n + k] = handles[v][static_cast<Eigen::Index>(axis)];
      x[axis * n + k] = u[v][static_cast<Eigen::Index>(axis)];
      constant[axis * n + k] = g[axis * n + own];
    }
  }
}

void Settler::State::finish(std::span<const double> from, std::span<Vector3d> u) const {
  for (std::size_t r = 0; r < rings.row_count(); ++r) u[rings.vertices[r]] = displacement[r];
  for (std::size_t k = 0; k < system.size(); ++k) u[vertex(k)] = of_unknown(from, k);
}

void Settler::State::fit_rotations(std::span<const double> from) {
  parallel_for(system.size(), kUnknownsPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      displacement[rings.unknown_rows[k]] = of_unknown(from, k);
    }
  });
  rotations->fit_rotations(displacement, energies);
}

// g = argmin over u with the rotations fixed.
void Settler::State::global_step() {
  rotations->rotate_laplacians(g);
  parallel_for(g.size(), 3 * kUnknownsPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) g[i] += constant[i];
  });
  system.solve_in_elimination_order(g, 3);
}

// Of x with the rotations last fitted, and of the step from x to g. Sums go task by task, so that
// they do not depend on the number of threads.
Settler::State::Measures Settler::State::measure() {
  parallel_for(partial.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t task = begin; task < end; ++task) {
      Measures& sum = partial[task] = {};
      const std::size_t last = std::min((task + 1) * kUnknownsPerTask, system.size());
      for (std::size_t k = task * kUnknownsPerTask; k < last; ++k) {
        const Vector3d at = of_unknown(x, k);
        const double step = (of_unknown(g, k) - at).squaredNorm();
        sum.residual += step;
        sum.largest_step = std::max(sum.largest_step, step);
        if (weights[k] > 0.0) {
          sum.energy += weights[k] * (at - of_unknown(wanted, k)).squaredNorm();
        }
      }
    }
  });
  Measures all;
  for (const Measures& sum : partial) {
    all.residual += sum.residual;
    all.largest_step = std::max(all.largest_step, sum.largest_step);
    all.energy += sum.energy;
  }
  all.residual = std::sqrt(all.residual);
  all.largest_step = std::sqrt(all.largest_step) / mean_edge;
  all.energy +=
      Eigen::Map<const Eigen::ArrayXd>(energies.data(), static_cast<Eigen::Index>(energies.size()))
          .sum();
  return all;
}

Settler::Settler(Kernels& kernels, const LaplacianSystem& system, const SettleOptions& options) {
  check(options);
  state_ = std::make_unique<State>(kernels, system, options);
}

Settler::~Settler() = default;
Settler::Settler(Settler&&) noexcept = default;
Settler& Settler::operator=(Settler&&) noexcept = default;

SettleResult Settler::settle(std::span<const Vector3d> wanted, std::span<Vector3d> u,
                             const Progress& progress) {
  state_->begin(wanted, u);
  state_->anderson.restart();
  return iterate(state_->anderson, u, progress);
}

SettleResult Settler::follow(std::span<const Vector3d> wanted, std::span<Vector3d> u,
                             const Progress& progress) {
  State& s = *state_;
  if (!s.following) s.following.emplace(3 * s.system.size(), kFollowingWindow);
  s.begin(wanted, u);
  s.following->carry_on();
  return iterate(*s.following, u, progress);
}

void Settler::begin_drag() {
  if (state_->following) state_->following->restart();
}

// From where `begin` has put the unknowns.
SettleResult Settler::iterate(Anderson& anderson, std::span<Vector3d> u, const Progress& progress) {
  State& s = *state_;
  SettleResult result;
  if (s.system.size() == 0) {
    s.finish(s.x, u);
    result.settled = true;
    return result;
  }
  // Neither the residual nor the energy falls with every step, but an accelerated step after which
  // both have risen has led away, and is undone.
  constexpr double kNone = std::numeric_limits<double>::infinity();
  double last_residual = kNone;
  double last_energy = kNone;
  try {
    while (!result.settled && result.iterations < s.options.max_iterations) {
      report_progress(progress, "settle",
                      static_cast<double>(result.iterations) / s.options.max_iterations);
      s.fit_rotations(s.x);
      s.global_step();
      ++result.iterations;
      const auto [residual, largest_step, energy] = s.measure();
      result.last_step = largest_step;
      result.settled = largest_step <= s.options.tolerance;
      if (result.settled || !s.options.accelerate) {
        std::copy(s.g.begin(), s.g.end(), s.x.begin());
      } else if (residual > last_residual && energy > last_energy) {
        anderson.step_back(s.x);
        last_residual = last_energy = kNone;
      } else {
        anderson.advance(s.x, s.g);
        last_residual = residual;
        last_energy = energy;
      }
    }
  } catch (const Cancelled&) {
    s.finish(s.x, u);
    throw;
  }
  s.finish(s.x, u);
  s.fit_rotations(s.x);
  result.energy = s.measure().energy;
  return result;
}

}  // namespace lapwing
