#pragma once

#include <functional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "lapwing/elastic/energy_minimizer.h"
#include "lapwing/laplacian/laplacian_system.h"

namespace lapwing {

/// The rotation of one free handle while a surface settles. Vectors over the unknowns are in
/// elimination order: x of all, then y, then z.
///
/// A matrix P that fixes a handle is far too stiff against rotations of the handle. Eliminating the
/// rotation gives P - U K^-1 U' (ENERGY.md section 6). Here U = W B, and column k of B holds the
/// velocities of the handle's vertices in a rotation about axis k. K is tr(C) I - C, where C is the
/// covariance of the handle's positions and its rotated shape. The inverse is
///
///     P^-1 + P^-1 U (K - U' P^-1 U)^-1 U' P^-1      (Sherman, Morrison, Woodbury).
///
/// K and U' P^-1 U nearly cancel, so K must be evaluated at the current pose. Under compression,
/// the K of the unstrained handle is used instead, which keeps the matrix positive semidefinite. A
/// step along a straight line would enlarge the handle, so steps rotate it along an arc
/// (`begin_step`, `bend`).
class FreeRotation {
 public:
  /// `rows` and `places` are those of the handle's vertices among RegionRings::vertices and among
  /// the unknowns; `weights` is W of each unknown. Solves for P^-1 U by the n x n factor of
  /// `system` unless the handle's shape is unchanged.
  void place(const FreeHandle& handle, std::vector<Index> rows, std::vector<Index> places,
             std::span<const double> weights, const LaplacianSystem& system);

  /// Fits the rotation to the unknowns `x`. Then writes the displacements that it prescribes for
  /// the handle's vertices to `prescribed`, which has one vector per row.
  void fit(std::span<const double> x, std::span<Eigen::Vector3d> prescribed);

  /// Switches back to the n x n system. Its P^-1 U can be used at any rotation, because P is the
  /// same for x, y and z.
  void respond_by_system();
  /// Computes P^-1 U for another P, at the last fitted rotation. `solve` replaces a right-hand side
  /// by its solution.
  void respond_by(const std::function<void(std::span<double>)>& solve);

  /// P was factored at an earlier rotation. Rotates the handle's vectors of a right-hand side to
  /// that rotation, and those of the solution back. Does nothing for the n x n system.
  void rotate_to_factor(std::span<double> b) const;
  void rotate_from_factor(std::span<double> solution) const;

  /// Turns P^-1 b into the solution of the matrix with the rotation eliminated, in place.
  void add_turn(std::span<double> solution) const;

  /// Starts a step along -`direction` from the surface of the last fit.
  void begin_step(std::span<const double> direction);
  /// Adds to `x`, a point at `length` along the straight step, the difference between the arc and
  /// the straight line.
  void bend(double length, std::span<double> x) const;

  const FreeHandle& handle() const { return handle_; }
  const Eigen::Matrix3d& rotation() const { return rotation_; }

 private:
  void turn_handle(const Eigen::Matrix3d& by, std::span<double> field) const;
  Eigen::Vector3d torque(std::span<const double> field, const Eigen::Matrix3d& R) const;
  Eigen::Matrix3d unstrained_stiffness() const;
  Eigen::Matrix3d inverse_stiffness(const Eigen::Matrix3d& of_response) const;

  FreeHandle handle_;
  std::vector<Index> rows_;
  std::vector<Index> places_;
  std::vector<double> held_;  ///< W of the handle's vertices
  Eigen::Matrix3d rotation_ = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Zero();  ///< of positions and rotated shape
  /// The n x n solution for the right-hand side W times the unrotated shape. On the handle it is
  /// close to the shape itself.
  std::vector<double> response_;
  Eigen::Matrix3d response_stiffness_ = Eigen::Matrix3d::Zero();  ///< U' P^-1 U of it, unrotated
  /// P^-1 U of another P, column by column; empty for the n x n system.
  std::vector<double> columns_;
  Eigen::Matrix3d columns_inverse_ = Eigen::Matrix3d::Zero();  ///< (K - U' P^-1 U)^-1 then
  Eigen::Matrix3d at_columns_ = Eigen::Matrix3d::Identity();   ///< the rotation then
  Eigen::Vector3d turn_ = Eigen::Vector3d::Zero();             ///< of the step to come, radians
  Eigen::Matrix3d at_step_ = Eigen::Matrix3d::Identity();      ///< the rotation at its start
};

}  // namespace lapwing
