#include "lapwing/deform/response_basis.h"

#include <string>

#include "lapwing/base/limits.h"
#include "lapwing/base/parallel.h"

namespace lapwing {

using Eigen::Vector3d;

namespace {

constexpr std::size_t kMovedPerTask = 4096;

}  // namespace

Numbers scale_forces(const EditSystem& system, std::span<const double> growth) {
  const EnergyWeights& weights = system.laplacian->weights();
  const Adjacency& rings = system.topology.rings;
  const Positions& rest = *system.rest;
  const Unknowns& unknowns = system.constraints.unknowns;
  // Minus half of the gradient of E by the unknowns.
  std::vector<Vector3d> force(rest.size(), Vector3d::Zero());
  for (std::size_t r = 0; r < system.region.roi.size(); ++r) {
    const Index i = system.region.roi[r];
    if (growth[r] == 0.0) continue;
    Vector3d delta = Vector3d::Zero();
    for (std::size_t e = rings.starts[i]; e < rings.starts[i + 1]; ++e) {
      delta += weights.laplacian[e] * (rest[i] - rest[rings.values[e]]);
    }
    const Vector3d pull = growth[r] * weights.rows[i] * delta;
    force[i] += pull;
    for (std::size_t e = rings.starts[i]; e < rings.starts[i + 1]; ++e) {
      const Index j = rings.values[e];
      const Vector3d of_edge = growth[r] * weights.stiffness[e] * (rest[i] - rest[j]);
      force[i] += of_edge;
      force[j] -= weights.laplacian[e] * pull + of_edge;
    }
  }
  Numbers of_unknowns(3 * unknowns.size());
  for (std::size_t u = 0; u < unknowns.size(); ++u) {
    Eigen::Map<Vector3d>(of_unknowns.data() + 3 * u) = force[unknowns.vertices[u]];
  }
  return of_unknowns;
}

double growth_of(const HandleFrame& frame, std::span<const double> parameters) {
  return (parameters[0] + parameters[5] + parameters[10]) / (3.0 * frame.radius);
}

std::vector<Vector3d> linear_displacement(const EditSystem& system, const ResponseSystem& response,
                                          std::span<const Vector3d> wanted,
                                          std::span<const double> forces) {
  const Unknowns& unknowns = system.constraints.unknowns;
  Numbers x(3 * unknowns.size());
  response.right_hand_side(wanted, x);
  for (std::size_t i = 0; i < forces.size(); ++i) x[i] += forces[i];
  response.solve_in_place(x, 1);
  std::vector<Vector3d> u(system.rest->size(), Vector3d::Zero());
  for (const Index v : system.moving) {
    const Index at = unknowns.of_vertex[v];
    u[v] = at == kNoIndex ? wanted[v] : Vector3d(Eigen::Map<const Vector3d>(x.data() + 3 * at));
  }
  return u;
}

Numbers response_basis(const EditSystem& system, const ResponseSystem& response,
                       std::span<const std::size_t> handles, const HandleWeights* shares,
                       const Progress& progress) {
  const Unknowns& unknowns = system.constraints.unknowns;
  const std::size_t column = 3 * system.moving.size();
  const std::size_t n = 3 * unknowns.size();
  require_memory(sizeof(double) * kMotionParameters * (column * handles.size() + n),
                 "the response of " + std::to_string(system.moving.size()) + " vertices to " +
                     std::to_string(handles.size()) + " handles",
                 "drag fewer handles at a time, or choose a smaller region");
  Numbers basis(column * kMotionParameters * handles.size());
  Numbers x(kMotionParameters * n);
  // Allocated once, since it spans the whole mesh.
  std::vector<Vector3d> wanted;
  std::vector<Vector3d> u;  // only for loose parts
  if (!system.loose.empty()) u.assign(system.rest->size(), Vector3d::Zero());
  for (std::size_t at = 0; at < handles.size(); ++at) {
    const std::size_t h = handles[at];
    report_progress(progress, "response",
                    static_cast<double>(at) / static_cast<double>(handles.size()));
    const auto unit = [&](std::size_t k) {
      std::vector<double> q(system.column_count(), 0.0);
      q[h * kMotionParameters + k] = 1.0;
      return q;
    };
    // The growth for one more unit of the handle's scale.
    std::vector<double> growth_of_roi(system.region.roi.size(), 0.0);
    Numbers force;
    if (shares != nullptr) {
      growth_of_roi = shares->of_handle(h);
      force = scale_forces(system, growth_of_roi);
    }
    for (std::size_t k = 0; k < kMotionParameters; ++k) {
      const auto b = std::span(x).subspan(k * n, n);
      const std::vector<double> q = unit(k);
      system.wanted_displacement(q, wanted);
      response.right_hand_side(wanted, b);
      const double growth =
          growth_of(system.frames[h], std::span(q).subspan(h * kMotionParameters));
      if (growth == 0.0) continue;
      for (std::size_t i = 0; i < force.size(); ++i) b[i] += growth * force[i];
    }
    response.solve_in_place(x, kMotionParameters);
    for (std::size_t k = 0; k < kMotionParameters; ++k) {
      const std::vector<double> q = unit(k);
      system.wanted_displacement(q, wanted);
      // Moving vertices that are not unknowns are hard handles and loose parts.
      const auto displacement_of = [&](Index v) -> Vector3d {
        const Index i = unknowns.of_vertex[v];
        return i == kNoIndex ? wanted[v] : Eigen::Map<const Vector3d>(x.data() + k * n + 3 * i);
      };
      double* const out = basis.data() + (at * kMotionParameters + k) * column;
      const auto write = [&](const auto& displacement) {
        parallel_for(system.moving.size(), kMovedPerTask, [&](std::size_t begin, std::size_t end) {
          for (std::size_t m = begin; m < end; ++m) {
            Eigen::Map<Vector3d>(out + 3 * m) = displacement(system.moving[m]);
          }
        });
      };
      if (system.loose.empty()) {
        write(displacement_of);
        continue;
      }
      for (const Index v : system.moving) u[v] = displacement_of(v);
      const double of_column =
          growth_of(system.frames[h], std::span(q).subspan(h * kMotionParameters));
      std::vector<double> growth(u.size(), 0.0);
      for (std::size_t r = 0; r < growth_of_roi.size(); ++r) {
        growth[system.region.roi[r]] = of_column * growth_of_roi[r];
      }
      system.loose.carry_linear(wanted, growth, u);
      write([&](Index v) { return u[v]; });
    }
  }
  return basis;
}

}  // namespace lapwing
