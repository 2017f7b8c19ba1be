#include "lapwing/render/ground_grid.h"

#include <cmath>

namespace lapwing {
namespace {

double spacing_up_to(double most) {
  const double power = std::pow(10.0, std::floor(std::log10(most)));
  return power * (most >= 5.0 * power ? 5.0 : most >= 2.0 * power ? 2.0 : 1.0);
}

Eigen::Index index_of(UpAxis up) {
  return up == UpAxis::y ? 1 : 2;
}

}  // namespace

Bounds GroundGrid::bounds() const {
  Eigen::Vector3d half = Eigen::Vector3d::Constant(radius);
  half[index_of(up)] = 0.0;
  return {center - half, center + half};
}

GroundGrid ground_grid(const Bounds& bounds, UpAxis up) {
  const double size = bounds.diagonal() > 0.0 ? bounds.diagonal() : 1.0;
  GroundGrid grid;
  grid.up = up;
  grid.spacing = spacing_up_to(0.1 * size);
  grid.radius = 1.5 * size;
  grid.center = grid.spacing * (bounds.center() / grid.spacing).array().round().matrix();
  // The grid lies a little below the mesh, so that a flat base of the mesh does not have the same
  // depth as the grid.
  const Eigen::Index axis = index_of(up);
  grid.center[axis] = bounds.min[axis] - 1e-4 * size;
  return grid;
}

}  // namespace lapwing
