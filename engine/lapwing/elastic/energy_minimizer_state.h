#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "lapwing/base/parallel.h"
#include "lapwing/elastic/energy_minimizer.h"
#include "lapwing/elastic/free_rotation.h"
#include "lapwing/elastic/lbfgs_history.h"

namespace lapwing {

/// The members of an EnergyMinimizer. The iterations are in energy_minimizer.cpp, the line search
/// in line_search.cpp, and energy and gradient in energy_evaluation.cpp.
struct EnergyMinimizer::State {
  const LaplacianSystem& system;
  const std::shared_ptr<const RegionRings> shared_rings;
  const RegionRings& rings = *shared_rings;
  SettleOptions options;
  double mean_edge;
  std::unique_ptr<RingRotations> rotations;
  Preconditioner* const given_preconditioner;
  Preconditioner* preconditioner = nullptr;  ///< null after a factorization has failed
  bool at_rest = false;                      ///< true if the last call was `follow_at_rest`
  int taken = 0;                             ///< number of iterations since `begin_schedule`
  bool by_hessian = false;                   ///< true if directions come from the preconditioner
  /// Value of `taken` at which the next factorization is due.
  int next_factorization = 0;
  /// True if the minimization may end with a step of the n x n factor. Such a step may be far
  /// shorter than the distance to the minimum.
  bool may_end_by_factor = false;
  double iteration_ms = 0.0;  ///< time of the last iteration without factorization
  double last_step = 0.0;     ///< length of the last step, in mean edge lengths
  bool is_placed = false;     ///< true if `at` was evaluated last
  Lbfgs history;

  // Vectors over the unknowns are in elimination order: x of all, then y, then z.
  std::vector<Eigen::Vector3d> displacement;  ///< per vertex of RegionRings::vertices
  std::vector<double> energies;               ///< one per row of the rings
  std::vector<Eigen::Matrix3d> stretch;       ///< per row of the rings; empty: all are the identity
  std::vector<double> weights;                ///< W of each unknown
  std::vector<Eigen::Vector3d> prescribed;    ///< per vertex of RegionRings::vertices
  /// `prescribed`, with the fitted positions of free handles.
  std::vector<Eigen::Vector3d> fitted;
  std::vector<double> forces;  ///< per unknown; empty if no forces act
  std::vector<double> direction;
  std::vector<double> correction;

  // A surface, its energy E, and half of the gradient of E.
  struct Point {
    std::vector<double> x;
    std::vector<double> gradient;
    double energy = 0.0;
    double force = 0.0;  ///< norm of the forces of constraints and springs
  };
  Point at;
  Point next;

  // A spring of the system, with the row and the unknown of each corner. A prescribed corner has
  // kNoIndex in `places`.
  struct PlacedSpring {
    Spring spring;
    std::array<Index, 3> rows{};
    std::array<Index, 3> places{};
  };
  std::vector<PlacedSpring> springs;
  std::vector<FreeRotation> free_rotations;  ///< one per free handle

  struct Sums {
    double energy = 0.0;
    double force = 0.0;
    double slope = 0.0;
    double gradient = 0.0;
    double step = 0.0;  ///< length of the longest vertex step
  };
  std::vector<Sums> partial;  ///< per task

  State(Kernels& kernels, const LaplacianSystem& laplacian, const SettleOptions& o,
        Preconditioner* hessian);

  void reset_history();
  void begin_schedule(int before_hessian);
  bool has_stretch_of(const MinimizerTarget& target) const;
  bool is_at(const MinimizerTarget& target, std::span<const Eigen::Vector3d> u) const;
  void place(const MinimizerTarget& target, std::span<const Eigen::Vector3d> u);
  void reevaluate();
  void read_unknowns(std::span<const Eigen::Vector3d> u, std::vector<double>& x) const;
  void finish(std::span<Eigen::Vector3d> u) const;
  void place_springs();
  void place_free_handles(const MinimizerTarget& target);
  void evaluate(Point& point);
  Sums pull_by_springs(Point& point) const;
  bool is_hessian_due() const;
  void factorize_hessian();
  void fall_back_to_factor();
  void use_factor_for_turns();
  Sums find_direction(bool accurate = false);
  void go(double length);
  void correct();
  bool line_search(double slope);
  bool must_end_by_hessian() const;
  void accept_next();

  Index vertex(std::size_t k) const { return rings.vertices[rings.unknown_rows[k]]; }
  Eigen::Vector3d of_unknown(std::span<const double> numbers, std::size_t k) const {
    const std::size_t n = system.size();
    return {numbers[k], numbers[n + k], numbers[2 * n + k]};
  }
  static constexpr std::size_t kUnknownsPerTask = 1024;
  // Sums `add(k, sums)` over all unknowns, task by task, so that the result does not depend on the
  // number of threads.
  template <typename Add>
  Sums sum_over_unknowns(const Add& add) {
    parallel_for(partial.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t task = begin; task < end; ++task) {
        Sums sum;  // local, because the entries of adjacent tasks share a cache line
        const std::size_t last = std::min((task + 1) * kUnknownsPerTask, system.size());
        for (std::size_t k = task * kUnknownsPerTask; k < last; ++k) add(k, sum);
        partial[task] = sum;
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

}  // namespace lapwing
