#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "lapwing/base/parallel.h"
#include "lapwing/settle/free_rotation.h"
#include "lapwing/settle/lbfgs.h"
#include "lapwing/settle/settle.h"

namespace lapwing {

/// How settling goes, in numbers of iterations.
struct SettlePace {
  int plain = 0;         ///< by the n x n factor, before the tangent is worth its factorization
  int tangent = 0;       ///< by one tangent, before the surface has turned on from it
  /// Plain ones at most as long as steps are long, where a tangent would soon be of another pose.
  int most_plain = 0;
  bool ends_plain = true;     ///< whether a plain step may be what settling ends by
};

/// What a Settler holds. Its iterations are in settle.cpp, the surface it moves, whose energy and
/// gradient they go by, in settler_surface.cpp.
struct Settler::State {
  const LaplacianSystem& system;
  const std::shared_ptr<const RegionRings> shared_rings;
  const RegionRings& rings = *shared_rings;
  SettleOptions options;
  double mean_edge;
  std::unique_ptr<RingRotations> rotations;
  TurnedTangent* const given_tangent;
  TurnedTangent* tangent = nullptr;  ///< the same until it could not be turned
  SettlePace pace;
  bool at_rest = false;       ///< whether `pace` is that of frames whose target rests
  int taken = 0;              ///< iterations at this pace
  bool by_tangent = false;    ///< whether directions come from the tangent
  int next_turn = 0;          ///< the iteration before which it is renewed
  double iteration_ms = 0.0;  ///< of the last one, without the tangent's factorization
  double last_step = 0.0;     ///< in mean edge lengths
  bool is_placed = false;  ///< whether what was evaluated last is `at`
  Lbfgs history;

  // Vectors over the unknowns, which come in the order of elimination, hold x of all, then y, then
  // z.
  std::vector<Eigen::Vector3d> displacement;  ///< of RegionRings::vertices
  std::vector<double> energies;               ///< per row
  std::vector<Eigen::Matrix3d> stretch;       ///< per row; empty for the identity
  std::vector<double> weights;                ///< W of each unknown
  std::vector<Eigen::Vector3d> given;         ///< SettleTarget::wanted of RegionRings::vertices
  std::vector<Eigen::Vector3d>
      wanted;  ///< `given`, replaced on free handles by the fitted positions
  std::vector<double> forces;                 ///< none where empty
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
  std::vector<FreeRotation> free_rotations;  ///< one per free handle

  struct Sums {
    double energy = 0.0;
    double force = 0.0;
    double slope = 0.0;
    double gradient = 0.0;
    double step = 0.0;  ///< the largest
  };
  std::vector<Sums> partial;  ///< per task

  State(Kernels& kernels, const LaplacianSystem& laplacian, const SettleOptions& o,
        TurnedTangent* turned);

  void begin_anew();
  void begin_pace(const SettlePace& of);
  bool has_stretch_of(const SettleTarget& target) const;
  bool is_at(const SettleTarget& target, std::span<const Eigen::Vector3d> u) const;
  void place(const SettleTarget& target, std::span<const Eigen::Vector3d> u);
  void place_again();
  void read_unknowns(std::span<const Eigen::Vector3d> u, std::vector<double>& x) const;
  void finish(std::span<Eigen::Vector3d> u) const;
  void place_springs();
  void place_free_handles(const SettleTarget& target);
  void evaluate(Point& point);
  Sums pull_by_springs(Point& point) const;
  bool is_turn_due() const;
  void turn_tangent();
  void leave_tangent();
  void use_factor_for_turns();
  Sums find_direction(bool well = false);
  void go(double length);
  bool step(double slope);
  void go_farther(double share);
  bool must_turn_to_end() const;
  void take_next();

  Index vertex(std::size_t k) const { return rings.vertices[rings.unknown_rows[k]]; }
  Eigen::Vector3d of_unknown(std::span<const double> numbers, std::size_t k) const {
    const std::size_t n = system.size();
    return {numbers[k], numbers[n + k], numbers[2 * n + k]};
  }
  static constexpr std::size_t kUnknownsPerTask = 1024;
  // Adds up `add(k, sums)` of every unknown; task by task, so that the result does not depend on
  // the number of threads.
  template <typename Add>
  Sums sum_over_unknowns(const Add& add) {
    parallel_for(partial.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t task = begin; task < end; ++task) {
        Sums sum;  // not in place: tasks beside each other would write to one line of the caches
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
