#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "lapwing/mesh/topology.h"

namespace lapwing {

/// The symmetric Dirichlet energy of a planar triangulation relative to its rest shape (Smith and
/// Schaefer 2015, eq. 3): the weighted mean over the triangles of
///     (|J|^2 + |J^-1|^2) / 2,  J = d current / d rest.
/// This is 2 for a triangle that only rotates, infinite for one that is flat or turned over.
class SymmetricDirichlet {
 public:
  /// The weights are areas at rest, with a floor so that the smallest triangles count as well.
  SymmetricDirichlet(std::span<const Triangle> triangles, std::span<const Eigen::Vector2d> rest);

  std::size_t size() const { return triangles_.size(); }
  double energy(std::span<const Eigen::Vector2d> points) const;

  /// Derivatives of the energy of one triangle, by its corners' coordinates in order (x0, y0, x1,
  /// ...). The Hessian is projected to its positive semidefinite part in closed form.
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
  std::vector<Eigen::Matrix2d> inverse_edges_;  ///< of the rest edges from corner 0, in columns
  std::vector<double> areas_;                   ///< twice those at rest
  std::vector<double> weights_;                 ///< sum to 1
};

}  // namespace lapwing
