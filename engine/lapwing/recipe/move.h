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

/// x -> pivot + scale R (x - pivot) + translate.
struct SimilarityMove {
  Eigen::Vector3d translate = Eigen::Vector3d::Zero();
  AxisRotation rotate;
  double scale = 1.0;                         ///< above 0
  std::optional<Eigen::Vector3d> pivot = {};  ///< the handle's centroid when not given
  bool operator==(const SimilarityMove&) const = default;
};

/// x -> A x + t, the columns of (A | t).
struct MatrixMove {
  Eigen::Matrix<double, 3, 4> matrix = Eigen::Matrix<double, 3, 4>::Identity();
  bool operator==(const MatrixMove&) const = default;
};

/// How a handle moves, as a person wrote it.
using Move = std::variant<SimilarityMove, MatrixMove>;

/// The map of space that `move` stands for. A move by nothing gives the identity bit for bit.
Eigen::Affine3d to_affine(const Move& move, const Eigen::Vector3d& handle_centroid);

}  // namespace lapwing
