// Energy and gradient of the surface that an EnergyMinimizer moves (energy_minimizer.h).
#include <algorithm>
#include <cmath>
#include <utility>

#include "lapwing/elastic/energy_minimizer_state.h"

namespace lapwing {

using Eigen::Vector3d;

bool EnergyMinimizer::State::has_stretch_of(const MinimizerTarget& target) const {
  if (target.rest_stretch.empty()) return stretch.empty();
  if (stretch.empty()) return false;
  for (std::size_t r = 0; r < rings.row_count(); ++r) {
    if (target.rest_stretch[rings.vertices[r]] != stretch[r]) return false;
  }
  return true;
}

// Returns true if `at` contains the surface `u`, evaluated for `target`.
bool EnergyMinimizer::State::is_at(const MinimizerTarget& target,
                                   std::span<const Vector3d> u) const {
  if (!is_placed || forces.empty() != target.forces.empty()) return false;
  const auto is_of = [](const FreeRotation& rotation, const FreeHandle& handle) {
    return rotation.handle() == handle;
  };
  if (!std::ranges::equal(free_rotations, target.free_handles, is_of)) return false;
  // Positions are compared first, because they differ in nearly all frames.
  for (std::size_t k = 0; k < system.size(); ++k) {
    if (u[vertex(k)] != of_unknown(at.x, k)) return false;
    if (!forces.empty() && target.forces[vertex(k)] != of_unknown(forces, k)) return false;
  }
  for (std::size_t r = 0; r < rings.vertices.size(); ++r) {
    if (target.prescribed[rings.vertices[r]] != prescribed[r]) return false;
  }
  return has_stretch_of(target);
}

// Sets `at` to the surface `u` and evaluates it, unless this has already been done.
void EnergyMinimizer::State::place(const MinimizerTarget& target, std::span<const Vector3d> u) {
  if (is_at(target, u)) return;
  is_placed = false;  // in case the evaluation is cancelled
  const std::vector<int>& order = system.elimination_order();
  const std::size_t n = system.size();
  weights.resize(n);
  parallel_for(n, kUnknownsPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      weights[k] = system.constraints().W[static_cast<std::size_t>(order[k])];
    }
  });
  parallel_for(fitted.size(), kUnknownsPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t r = begin; r < end; ++r) {
      prescribed[r] = fitted[r] = displacement[r] = target.prescribed[rings.vertices[r]];
    }
  });
  if (!has_stretch_of(target)) {
    stretch.clear();
    for (std::size_t r = 0; r < rings.row_count() && !target.rest_stretch.empty(); ++r) {
      stretch.push_back(target.rest_stretch[rings.vertices[r]]);
    }
    rotations->set_rest_stretch(stretch);
  }
  place_springs();
  place_free_handles(target);
  forces.resize(target.forces.empty() ? 0 : 3 * n);
  if (!forces.empty()) read_unknowns(target.forces, forces);
  read_unknowns(u, at.x);
  reevaluate();
}

// Evaluates `at` again after the evaluation of another surface.
void EnergyMinimizer::State::reevaluate() {
  evaluate(at);
  is_placed = true;
}

void EnergyMinimizer::State::read_unknowns(std::span<const Vector3d> u,
                                           std::vector<double>& x) const {
  const std::size_t n = system.size();
  parallel_for(n, kUnknownsPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const Vector3d& of = u[vertex(k)];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        x[axis * n + k] = of[static_cast<Eigen::Index>(axis)];
      }
    }
  });
}

void EnergyMinimizer::State::place_springs() {
  springs.clear();
  if (system.springs().empty()) return;
  const Unknowns& unknowns = system.constraints().unknowns;
  const std::vector<Index> row_of = inverse_index(rings.vertices, unknowns.of_vertex.size());
  const std::vector<Index> place_of = inverse_index(rings.unknown_rows, rings.vertices.size());
  for (const Spring& spring : system.springs()) {
    PlacedSpring& placed = springs.emplace_back(PlacedSpring{spring, {}, {}});
    for (std::size_t c = 0; c < 3; ++c) {
      placed.rows[c] = row_of[spring.corners[c]];
      placed.places[c] = place_of[placed.rows[c]];
    }
  }
}

// FreeRotation::place reuses the data of unchanged handles.
void EnergyMinimizer::State::place_free_handles(const MinimizerTarget& target) {
  const std::size_t count = target.free_handles.size();
  if (count == 0 && free_rotations.empty()) return;
  const std::vector<Index> row_of =
      inverse_index(rings.vertices, system.constraints().unknowns.of_vertex.size());
  const std::vector<Index> place_of = inverse_index(rings.unknown_rows, rings.vertices.size());
  free_rotations.resize(count);
  for (std::size_t h = 0; h < count; ++h) {
    const FreeHandle& handle = target.free_handles[h];
    std::vector<Index> rows;
    std::vector<Index> places;
    for (const Index v : handle.vertices) {
      rows.push_back(row_of[v]);
      places.push_back(place_of[rows.back()]);
    }
    free_rotations[h].place(handle, std::move(rows), std::move(places), weights, system);
  }
}

// Adds the springs to the gradient. Returns their energy and squared force.
EnergyMinimizer::State::Sums EnergyMinimizer::State::pull_by_springs(Point& point) const {
  const std::size_t n = system.size();
  Sums sum;
  for (const PlacedSpring& placed : springs) {
    const auto& [spring, rows, places] = placed;
    Vector3d off = -spring.prescribed;
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

void EnergyMinimizer::State::finish(std::span<Vector3d> u) const {
  for (std::size_t r = 0; r < rings.row_count(); ++r) u[rings.vertices[r]] = displacement[r];
  for (std::size_t k = 0; k < system.size(); ++k) u[vertex(k)] = of_unknown(at.x, k);
}

// Computes the energy and its gradient at point.x, with the optimal rotations.
void EnergyMinimizer::State::evaluate(Point& point) {
  is_placed = false;
  const std::size_t n = system.size();
  parallel_for(n, kUnknownsPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      displacement[rings.unknown_rows[k]] = of_unknown(point.x, k);
    }
  });
  for (FreeRotation& rotation : free_rotations) rotation.fit(point.x, fitted);
  rotations->fit_rotations(displacement, energies);
  rotations->energy_gradient(point.gradient);
  const Sums held = sum_over_unknowns([&](std::size_t k, Sums& sum) {
    for (std::size_t axis = 0; axis < 3 && !forces.empty(); ++axis) {
      const double force = forces[axis * n + k];
      sum.energy -= 2.0 * force * point.x[axis * n + k];
      point.gradient[axis * n + k] -= force;
    }
    if (!(weights[k] > 0.0)) return;
    const Vector3d off = of_unknown(point.x, k) - fitted[rings.unknown_rows[k]];
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

}  // namespace lapwing
