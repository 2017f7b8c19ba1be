#include "lapwing/deform/laplacian_response.h"

#include <string>

#include "lapwing/base/limits.h"

namespace lapwing {

using Eigen::Vector3d;

namespace {

constexpr std::size_t kCoordinates = kMotionParameters / 3;

// Adds the response of the region to each coordinate function of handle `h`.
void add_columns(const EditSystem& system, std::size_t h, std::span<double> columns) {
  const HandleFrame& frame = system.frames[h];
  const Positions& rest = *system.rest;
  const LaplacianSystem& laplacian = *system.laplacian;
  std::vector<Vector3d> coordinates(rest.size(), Vector3d::Zero());
  std::vector<Vector3d> one(rest.size(), Vector3d::Zero());
  const auto give = [&](Index v) {
    coordinates[v] = (rest[v] - frame.centroid) / frame.radius;
    one[v].x() = 1.0;
  };
  for (const Index v : system.region.handles[h]) give(v);
  for (const FalloffVertex& graded : system.region.graded) {
    if (graded.handle == h) give(graded.vertex);
  }
  for (const LoosePart& part : system.region.loose) {
    for (const LooseAnchor& anchor : part.anchors) {
      if (anchor.handle == h) give(anchor.vertex);
    }
  }
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

}  // namespace

Numbers laplacian_response(const EditSystem& system, std::span<const std::size_t> handles) {
  const std::size_t of_handle = system.moving.size() * kCoordinates;
  require_memory(sizeof(double) * of_handle * handles.size(),
                 "the response of " + std::to_string(system.moving.size()) + " vertices to " +
                     std::to_string(handles.size()) + " handles",
                 "drag fewer handles at a time, or choose a smaller region");
  Numbers columns(of_handle * handles.size());
  for (std::size_t k = 0; k < handles.size(); ++k) {
    add_columns(system, handles[k], std::span(columns).subspan(k * of_handle, of_handle));
  }
  return columns;
}

std::vector<Vector3d> laplacian_displacement(const EditSystem& system,
                                             std::span<const Vector3d> wanted, Springs springs) {
  const LaplacianSystem& laplacian = *system.laplacian;
  const std::size_t n = laplacian.size();
  std::vector<double> x(3 * n);
  laplacian.right_hand_side(wanted, x);
  if (springs == Springs::pull) laplacian.add_spring_forces(x);
  laplacian.solve_in_place(x, 3);
  std::vector<Vector3d> displacement(system.rest->size(), Vector3d::Zero());
  for (const Index v : system.moving) {
    const Index u = system.constraints.unknowns.of_vertex[v];
    displacement[v] = u == kNoIndex ? wanted[v] : Vector3d(x[u], x[n + u], x[2 * n + u]);
  }
  return displacement;
}

}  // namespace lapwing
