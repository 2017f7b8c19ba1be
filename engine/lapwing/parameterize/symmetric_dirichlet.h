#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "lapwing/mesh/topology.h"

namespace lapwing {

/// The symmetric Dirichlet energy of a planar triangulation relative to its rest shape (Smith and
/// Schaefer 2015, eq. 3): the weighted mean over the triangles of
///     (|J|^2 + |J^-1|^2) / 2,  J = d current / d rest.
/// The energy of a triangle is 2 if it only rotates, and infinite if it is flat or flipped.
class SymmetricDirichlet {
 public:
  /// The weights are the rest areas, with a lower bound so that the smallest triangles have an
  /// effect.
  SymmetricDirichlet(std::span<const Triangle> triangles, std::span<const Eigen::Vector2d> rest);

  std::size_t size() const { return triangles_.size(); }
  double energy(std::span<const Eigen::Vector2d> points) const;

  /// Derivatives of the energy of one triangle with respect to the coordinates (x0, y0, x1, ...) of
  /// its corners. The Hessian is projected to its positive semidefinite part in closed form.
  struct Part {
    Eigen::Vector<double, 6> gradient;
    Eigen::Matrix<double, 6, 6> hessian;
  };
  /// `points` must be bijective.
  Part part(std::size_t triangle, std::span<const Eigen::Vector2d> points) const;

 private:
  double energy_of(std::size_t triangle, std::span<const Eigen::Vector2d> points) const;
  Eigen::Matrix2d jacobian(std::size_t triangle, std::span<const Eigen::Vector2d> points) const;

  std::span<const Triangle> triangles_;
  /// Inverse of the matrix whose columns are the rest edges from corner 0.
  std::vector<Eigen::Matrix2d> inverse_edges_;
  std::vector<double> areas_;    ///< twice the rest areas
  std::vector<double> weights_;  ///< sum to 1
};

}  // namespace lapwing
