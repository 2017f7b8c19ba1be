#include "lapwing/recipe/move.h"

#include <numbers>

namespace lapwing {
namespace {

using Eigen::Affine3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d rotation_matrix(const AxisRotation& rotation) {
  // The formula leaves negative zeros behind at 0 degrees.
  if (rotation.degrees == 0.0) return Matrix3d::Identity();
  const double radians = rotation.degrees * std::numbers::pi / 180.0;
  return Eigen::AngleAxisd(radians, rotation.axis.normalized()).toRotationMatrix();
}

Affine3d affine_of(const SimilarityMove& move, const Vector3d& handle_centroid) {
  const Vector3d pivot = move.pivot.value_or(handle_centroid);
  Affine3d map = Affine3d::Identity();
  map.linear() = move.scale * rotation_matrix(move.rotate);
  map.translation() = (pivot - map.linear() * pivot) + move.translate;
  return map;
}

Affine3d affine_of(const MatrixMove& move, const Vector3d&) {
  Affine3d map = Affine3d::Identity();
  map.affine() = move.matrix;
  return map;
}

}  // namespace

Affine3d to_affine(const Move& move, const Vector3d& handle_centroid) {
  return std::visit([&](const auto& form) { return affine_of(form, handle_centroid); }, move);
}

}  // namespace lapwing
