#pragma once

#include <optional>
#include <variant>

#include <Eigen/Geometry>

namespace lapwing {

/// Right-handed rotation about `axis`, which may have any length except 0.
struct AxisRotation {
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  double degrees = 0.0;
  bool operator==(const AxisRotation&) const = default;
};

/// x -> pivot + R diag(scale) (x - pivot) + translate: scales along the coordinate axes, then
/// rotates.
struct SimilarityMove {
  Eigen::Vector3d translate = Eigen::Vector3d::Zero();
  AxisRotation rotate = {};
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();  ///< along x, y and z, all positive
  std::optional<Eigen::Vector3d> pivot = {};        ///< empty: the handle's centroid
  bool operator==(const SimilarityMove&) const = default;
};

/// x -> A x + t, where `matrix` is (A | t).
struct MatrixMove {
  Eigen::Matrix<double, 3, 4> matrix = Eigen::Matrix<double, 3, 4>::Identity();
  bool operator==(const MatrixMove&) const = default;
};

/// The motion of a handle, as the user wrote it.
using Move = std::variant<SimilarityMove, MatrixMove>;

/// What determines a handle's rotation.
enum class HandleOrientation {
  kept,  ///< the move
  /// The minimization. The move prescribes only the centre and the shape; its rotation is the start
  /// of the minimization.
  free,
};

/// Returns `move` as an affine map. Returns exactly the identity if the move changes nothing.
/// `share` interpolates from the identity (0) to the move (1). For a similarity, `share` multiplies
/// the translation and the angle, and the scale becomes scale^share; axis and pivot do not change.
/// A matrix is interpolated by `partial_motion`. The map is invertible if `share` is less than 1.
/// Throws InputError if the move is a matrix with a reflection and `share` is less than 1.
Eigen::Affine3d to_affine(const Move& move, const Eigen::Vector3d& handle_centroid,
                          double share = 1.0);

/// Returns the rotation of `move`, 0 degrees or more about an axis of length 1. The angle is that
/// of the request, for example 260 degrees. For a matrix, it is 0 to 180 degrees, and 0 if the
/// matrix contains a reflection.
AxisRotation turn_of(const Move& move);

/// Returns true if `move` is a matrix with a negative determinant, which reflects the handle.
bool mirrors(const Move& move);

}  // namespace lapwing
