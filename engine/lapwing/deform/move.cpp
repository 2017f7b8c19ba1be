#include "lapwing/deform/move.h"

#include <cmath>
#include <numbers>

#include <Eigen/LU>

#include "lapwing/base/errors.h"
#include "lapwing/deform/handle_motion.h"

namespace lapwing {
namespace {

using Eigen::Affine3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d rotation_matrix(const AxisRotation& rotation) {
  // At 0 degrees, the formula would return negative zeros.
  if (rotation.degrees == 0.0) return Matrix3d::Identity();
  const double radians = rotation.degrees * std::numbers::pi / 180.0;
  return Eigen::AngleAxisd(radians, rotation.axis.normalized()).toRotationMatrix();
}

Affine3d part_of(const SimilarityMove& move, const Vector3d& handle_centroid, double share) {
  const Vector3d pivot = move.pivot.value_or(handle_centroid);
  Affine3d map = Affine3d::Identity();
  const Vector3d scale = move.scale.array().pow(share);
  map.linear() = rotation_matrix({move.rotate.axis, share * move.rotate.degrees});
  for (Eigen::Index axis = 0; axis < 3; ++axis) map.linear().col(axis) *= scale[axis];
  map.translation() = (pivot - map.linear() * pivot) + share * move.translate;
  return map;
}

Affine3d affine_of(const MatrixMove& move) {
  Affine3d map = Affine3d::Identity();
  map.affine() = move.matrix;
  return map;
}

bool is_mirror(const MatrixMove& move) {
  return affine_of(move).linear().determinant() < 0.0;
}

Affine3d part_of(const MatrixMove& move, const Vector3d& handle_centroid, double share) {
  const Affine3d whole = affine_of(move);
  if (share == 1.0) return whole;
  if (is_mirror(move)) {
    throw InputError(
        "a matrix that mirrors cannot be divided into substeps, because no continuous motion leads "
        "to a mirror image; use a matrix with a positive determinant");
  }
  return partial_motion(whole, shortest_turn(whole), handle_centroid, share);
}

AxisRotation turn_of_form(const SimilarityMove& move) {
  const double degrees = move.rotate.degrees;
  const Vector3d axis = move.rotate.axis.normalized();
  return {degrees < 0.0 ? -axis : axis, std::abs(degrees)};
}

AxisRotation turn_of_form(const MatrixMove& move) {
  if (is_mirror(move)) return {};
  const Eigen::AngleAxisd turn = shortest_turn(affine_of(move));
  return {turn.axis(), turn.angle() * 180.0 / std::numbers::pi};
}

}  // namespace

Affine3d to_affine(const Move& move, const Vector3d& handle_centroid, double share) {
  return std::visit([&](const auto& form) { return part_of(form, handle_centroid, share); }, move);
}

AxisRotation turn_of(const Move& move) {
  return std::visit([](const auto& form) { return turn_of_form(form); }, move);
}

bool mirrors(const Move& move) {
  const auto* matrix = std::get_if<MatrixMove>(&move);
  return matrix != nullptr && is_mirror(*matrix);
}

}  // namespace lapwing
