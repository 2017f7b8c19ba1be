#include "lapwing/deform/linear_response.h"

#include <string>

#include "lapwing/base/limits.h"
#include "lapwing/base/parallel.h"

namespace lapwing {

using Eigen::Vector3d;

namespace {

constexpr std::size_t kCoordinates = kMotionParameters / 3;

void require_response_memory(const EditSystem& system, std::size_t numbers, std::size_t handles) {
  require_memory(sizeof(double) * numbers,
                 "the response of " + std::to_string(system.moving.size()) + " vertices to " +
                     std::to_string(handles) + " handles",
                 "drag fewer handles at a time, or choose a smaller region");
}

// Adds the response of the region to each coordinate function of handle `h`.
void add_columns(const EditSystem& system, std::size_t h, std::span<double> columns) {
  const HandleFrame& frame = system.frames[h];
  const Positions& rest = *system.rest;
  const LaplacianSystem& laplacian = *system.laplacian;
  std::vector<Vector3d> coordinates(rest.size(), Vector3d::Zero());
  std::vector<Vector3d> one(rest.size(), Vector3d::Zero());
  system.for_prescribed([&](std::size_t handle, Index v) {
    if (handle != h) return;
    coordinates[v] = (rest[v] - frame.centroid) / frame.radius;
    one[v].x() = 1.0;
  });
  const std::size_t n = laplacian.size();
  std::vector<double> x(6 * n);
  laplacian.right_hand_side(coordinates, std::span(x).first(3 * n));
  laplacian.right_hand_side(one, std::span(x).subspan(3 * n));
  laplacian.solve_in_place(std::span(x).first(kCoordinates * n), kCoordinates);

  std::vector<Vector3d> displaced = coordinates;
  std::vector<Vector3d> displaced_one = one;
  for (std::size_t u = 0; u < n; ++u) {
    const Index v = system.constraints.unknowns.vertices[u];
    displaced[v] = {x[u], x[n + u], x[2 * n + u]};
    displaced_one[v].x() = x[3 * n + u];
  }
  system.loose.carry_straight(coordinates, displaced);
  system.loose.carry_straight(one, displaced_one);
  for (std::size_t k = 0; k < kCoordinates; ++k) {
    double* out = columns.data() + k * system.moving.size();
    for (const Index v : system.moving) {
      *out++ = k == 3 ? displaced_one[v].x() : displaced[v][static_cast<Eigen::Index>(k)];
    }
  }
}

// Writes one column: the displacements of the moving vertices for the solution `x`. `scale` times
// `growth[r]` is the growth of the ring of the region's vertex r.
void write_column(const EditSystem& system, std::span<const Vector3d> prescribed,
                  std::span<const double> x, double scale, std::span<const double> growth,
                  double* out) {
  constexpr std::size_t kMovedPerTask = 4096;
  // Moving vertices that are not unknowns are hard handles and loose parts.
  const auto displacement_of = [&](Index v) -> Vector3d {
    const Index i = system.constraints.unknowns.of_vertex[v];
    return i == kNoIndex ? prescribed[v] : Eigen::Map<const Vector3d>(x.data() + 3 * i);
  };
  std::vector<Vector3d> u;  // per vertex of the mesh; empty without loose parts
  if (!system.loose.empty()) {
    u.assign(system.rest->size(), Vector3d::Zero());
    for (const Index v : system.moving) u[v] = displacement_of(v);
    std::vector<double> scaled(u.size(), 0.0);
    for (std::size_t r = 0; r < growth.size(); ++r)
      scaled[system.region.roi[r]] = scale * growth[r];
    system.loose.carry_linear(prescribed, scaled, u);
  }
  parallel_for(system.moving.size(), kMovedPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t m = begin; m < end; ++m) {
      const Index v = system.moving[m];
      Eigen::Map<Vector3d>(out + 3 * m) = u.empty() ? displacement_of(v) : u[v];
    }
  });
}

}  // namespace

Numbers laplacian_response(const EditSystem& system, std::span<const std::size_t> handles) {
  const std::size_t of_handle = system.moving.size() * kCoordinates;
  require_response_memory(system, of_handle * handles.size(), handles.size());
  Numbers columns(of_handle * handles.size());
  for (std::size_t k = 0; k < handles.size(); ++k) {
    add_columns(system, handles[k], std::span(columns).subspan(k * of_handle, of_handle));
  }
  return columns;
}

std::vector<Vector3d> laplacian_displacement(const EditSystem& system,
                                             std::span<const Vector3d> prescribed,
                                             Springs springs) {
  const LaplacianSystem& laplacian = *system.laplacian;
  const std::size_t n = laplacian.size();
  std::vector<double> x(3 * n);
  laplacian.right_hand_side(prescribed, x);
  if (springs == Springs::pull) laplacian.add_spring_forces(x);
  laplacian.solve_in_place(x, 3);
  std::vector<Vector3d> displacement(system.rest->size(), Vector3d::Zero());
  for (const Index v : system.moving) {
    const Index u = system.constraints.unknowns.of_vertex[v];
    displacement[v] = u == kNoIndex ? prescribed[v] : Vector3d(x[u], x[n + u], x[2 * n + u]);
  }
  return displacement;
}

Numbers scale_forces(const EditSystem& system, std::span<const double> growth) {
  const EnergyWeights& weights = system.laplacian->weights();
  const Adjacency& rings = system.topology.rings;
  const Positions& rest = *system.rest;
  const Unknowns& unknowns = system.constraints.unknowns;
  // Minus half of the gradient of E with respect to the vertex positions.
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
                                          std::span<const Vector3d> prescribed,
                                          std::span<const double> forces) {
  const Unknowns& unknowns = system.constraints.unknowns;
  Numbers x(3 * unknowns.size());
  response.right_hand_side(prescribed, x);
  for (std::size_t i = 0; i < forces.size(); ++i) x[i] += forces[i];
  response.solve_in_place(x, 1);
  std::vector<Vector3d> u(system.rest->size(), Vector3d::Zero());
  for (const Index v : system.moving) {
    const Index at = unknowns.of_vertex[v];
    u[v] = at == kNoIndex ? prescribed[v] : Vector3d(Eigen::Map<const Vector3d>(x.data() + 3 * at));
  }
  return u;
}

Numbers response_basis(const EditSystem& system, const ResponseSystem& response,
                       std::span<const std::size_t> handles, const HandleWeights* handle_weights,
                       const Progress& progress) {
  const std::size_t column = 3 * system.moving.size();
  const std::size_t n = 3 * system.constraints.unknowns.size();
  require_response_memory(system, kMotionParameters * (column * handles.size() + n),
                          handles.size());
  Numbers basis(column * kMotionParameters * handles.size());
  Numbers x(kMotionParameters * n);
  std::vector<Vector3d> prescribed;
  double* out = basis.data();
  for (std::size_t at = 0; at < handles.size(); ++at) {
    const std::size_t h = handles[at];
    report_progress(progress, "response",
                    static_cast<double>(at) / static_cast<double>(handles.size()));
    // Sets `prescribed` for the motion whose parameter k is 1 and whose other parameters are 0.
    // Returns the mean scale of that motion, minus 1.
    const auto set_unit = [&](std::size_t k) {
      std::vector<double> q(system.column_count(), 0.0);
      q[h * kMotionParameters + k] = 1.0;
      prescribed = system.displacement_of_handles(q, std::move(prescribed));
      return growth_of(system.frames[h], std::span(q).subspan(h * kMotionParameters));
    };
    // `growth` and `force` belong to a handle whose mean scale increases by 1.
    std::vector<double> growth(system.region.roi.size(), 0.0);
    Numbers force;
    if (handle_weights != nullptr) {
      growth = handle_weights->of_handle(h);
      force = scale_forces(system, growth);
    }
    for (std::size_t k = 0; k < kMotionParameters; ++k) {
      const auto b = std::span(x).subspan(k * n, n);
      const double scale = set_unit(k);
      response.right_hand_side(prescribed, b);
      if (scale == 0.0) continue;
      for (std::size_t i = 0; i < force.size(); ++i) b[i] += scale * force[i];
    }
    response.solve_in_place(x, kMotionParameters);
    for (std::size_t k = 0; k < kMotionParameters; ++k, out += column) {
      const double scale = set_unit(k);
      write_column(system, prescribed, std::span(x).subspan(k * n, n), scale, growth, out);
    }
  }
  return basis;
}

}  // namespace lapwing
