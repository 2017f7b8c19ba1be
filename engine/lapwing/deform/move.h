#pragma once

#include <optional>
#include <variant>

#include <Eigen/Geometry>

namespace lapwing {

/// Right-handed turn about `axis`, which need not be of length 1 but must not be 0.
struct AxisRotation {
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  double degrees = 0.0;
  bool operator==(const AxisRotation&) const = default;
};

/// x -> pivot + R diag(scale) (x - pivot) + translate: scales along the axes of the mesh, then
/// turns.
struct SimilarityMove {
  Eigen::Vector3d translate = Eigen::Vector3d::Zero();
  AxisRotation rotate;
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();  ///< along x, y and z, each above 0
  std::optional<Eigen::Vector3d> pivot = {};        ///< the handle's centroid when not given
  bool operator==(const SimilarityMove&) const = default;
};

/// x -> A x + t, the columns of (A | t).
struct MatrixMove {
  Eigen::Matrix<double, 3, 4> matrix = Eigen::Matrix<double, 3, 4>::Identity();
  bool operator==(const MatrixMove&) const = default;
};

/// How a handle moves, as a person wrote it.
using Move = std::variant<SimilarityMove, MatrixMove>;

/// What becomes of a handle's rotation.
enum class HandleOrientation {
  kept,  ///< the move says it
  free,  ///< the move says where the centre goes; the handle keeps its shape and turns as the
         ///< surface wants. A rotation in the move says where it begins.
};

/// The map of space that `move` stands for. A move by nothing gives the identity bit for bit.
Eigen::Affine3d to_affine(const Move& move, const Eigen::Vector3d& handle_centroid);

/// The move carried out in part: `share` 0 is the identity, 1 is `to_affine(move, centroid)` bit
/// for bit. A similarity moves by that share of its translation and of its angle, about the same
/// axis and pivot, and scales by scale^share along each axis. Of a matrix the rotation of its polar
/// decomposition turns by the share of its angle, its stretch S becomes (1 - share) I + share S,
/// and the centroid goes straight. Invertible below 1. Throws InputError for a part of a matrix
/// that mirrors.
Eigen::Affine3d to_affine(const Move& move, const Eigen::Vector3d& handle_centroid, double share);

/// By what `move` turns, 0 degrees or more about an axis of length 1: as written, so that 260
/// degrees are 260; of a matrix 0 to 180, and 0 for one that mirrors.
AxisRotation turn_of(const Move& move);

/// Whether `move` is a matrix that turns the handle into its mirror image (determinant below 0).
bool mirrors(const Move& move);

}  // namespace lapwing
