#include "tools/gizmo_frame.h"

#include <algorithm>

#include <Eigen/Eigenvalues>

#include "lapwing/laplacian/rotation.h"

namespace lapwing::viewer {
namespace {

using Eigen::Affine3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

// Below these shares, of the largest eigenvalue and of the area, there is no extent and no normal.
constexpr double kNoExtent = 1e-6;
constexpr double kShortNormal = 1e-3;

// Flips an axis that points down along the nearest world axis.
Vector3d pointing_up(const Vector3d& axis) {
  Eigen::Index largest = 0;
  axis.cwiseAbs().maxCoeff(&largest);
  return axis[largest] < 0.0 ? Vector3d(-axis) : axis;
}

Matrix3d principal_axes(const VertexSet& vertices, const Positions& positions) {
  Vector3d middle = Vector3d::Zero();
  for (const Index v : vertices) middle += positions[v];
  middle /= static_cast<double>(vertices.size());
  Matrix3d spread = Matrix3d::Zero();
  for (const Index v : vertices) {
    spread += (positions[v] - middle) * (positions[v] - middle).transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(spread);
  const Vector3d extents = solver.eigenvalues();  // ascending
  // A pin, or vertices on a line, span no plane.
  if (!(extents[1] > kNoExtent * extents[2])) return Matrix3d::Identity();
  Matrix3d axes;
  axes.col(0) = pointing_up(solver.eigenvectors().col(2));
  axes.col(1) = pointing_up(solver.eigenvectors().col(1));
  axes.col(2) = axes.col(0).cross(axes.col(1));
  return axes;
}

Matrix3d axes_at_normal(const VertexSet& vertices, const Mesh& surface) {
  const Topology& topology = surface.topology();
  Vector3d sum = Vector3d::Zero();
  double area = 0.0;
  for (const Index v : vertices) {
    for (const Index t : topology.vertex_triangles[v]) {
      const auto& [a, b, c] = topology.triangles[t];
      const Vector3d& from = surface.positions[a];
      const Vector3d twice = (surface.positions[b] - from).cross(surface.positions[c] - from);
      sum += twice;
      area += twice.norm();
    }
  }
  if (!(sum.norm() > kShortNormal * area)) return Matrix3d::Identity();
  Matrix3d axes;
  axes.col(2) = sum.normalized();
  Vector3d across = Vector3d::UnitX() - axes.col(2).x() * axes.col(2);
  if (across.norm() < 0.5) across = Vector3d::UnitY() - axes.col(2).y() * axes.col(2);
  axes.col(0) = across.normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

// Returns the mean of the vertices with a neighbour outside.
std::optional<Vector3d> middle_of_rim(const VertexSet& vertices, const Mesh& surface) {
  Vector3d sum = Vector3d::Zero();
  std::size_t count = 0;
  for (const Index v : vertices) {
    const auto ring = surface.topology().rings[v];
    const bool inside =
        std::ranges::all_of(ring, [&](Index w) { return std::ranges::binary_search(vertices, w); });
    if (inside) continue;
    sum += surface.positions[v];
    ++count;
  }
  if (count == 0) return std::nullopt;
  return sum / static_cast<double>(count);
}

}  // namespace

Matrix3d gizmo_axes(GizmoAxes axes, const AppState& state, std::size_t handle,
                    const Affine3d& motion) {
  if (axes == GizmoAxes::world) return Matrix3d::Identity();
  const VertexSet& vertices = state.selection.handles[handle].vertices;
  const Matrix3d at_rest = axes == GizmoAxes::local
                               ? principal_axes(vertices, state.rest->positions)
                               : axes_at_normal(vertices, *surface_of(state));
  return nearest_rotation(motion.linear()) * at_rest;
}

Vector3d gizmo_center(const GizmoChoices& choices, const AppState& state, std::size_t handle,
                      const Affine3d& motion) {
  const EditSelection& selection = state.selection;
  switch (choices.pivot) {
    case GizmoPivot::rim:
      if (const auto middle =
              middle_of_rim(selection.handles[handle].vertices, *surface_of(state))) {
        return motion * *middle;
      }
      break;
    case GizmoPivot::belt: {
      if (selection.belt.vertices.empty()) break;
      Vector3d sum = Vector3d::Zero();
      for (const Index v : selection.belt.vertices) sum += state.rest->positions[v];
      return sum / static_cast<double>(selection.belt.vertices.size());
    }
    case GizmoPivot::point:
      return choices.point;
    case GizmoPivot::origin:
      return Vector3d::Zero();
    case GizmoPivot::handle:
      break;
  }
  return motion * handle_centroid(state, handle);
}

}  // namespace lapwing::viewer
