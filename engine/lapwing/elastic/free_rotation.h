#pragma once

#include <functional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "lapwing/elastic/energy_minimizer.h"
#include "lapwing/laplacian/laplacian_system.h"

namespace lapwing {

/// The rotation of one free handle during a minimization. Vectors over the unknowns are in
/// elimination order: x of all unknowns, then y, then z.
///
/// A matrix P that fixes a handle is far too stiff against rotations of the handle. Eliminating the
/// rotation gives P - U K^-1 U' (ENERGY.md section 6). Here U = W B, and column k of B contains the
/// velocities of the handle's vertices for a rotation about axis k. K is tr(C) I - C, where C is
/// the covariance of the handle's positions and its rotated shape. The inverse is
///
///     P^-1 + P^-1 U (K - U' P^-1 U)^-1 U' P^-1      (Sherman, Morrison, Woodbury).
///
/// K and U' P^-1 U nearly cancel, so K must be evaluated at the current pose. Under compression,
/// the K of the unstrained handle is used instead, which keeps the matrix positive semidefinite. A
/// step along a straight line would enlarge the handle, so steps rotate it along an arc
/// (`begin_step`, `bend`).
class FreeRotation {
 public:
  /// `rows` contains the indices of the handle's vertices in RegionRings::vertices, `places` their
  /// indices among the unknowns in elimination order, and `weights` the entry of W for each
  /// unknown. Computes P^-1 U with the n x n factor of `system`, unless shape, weights and `places`
  /// are unchanged.
  void place(const FreeHandle& handle, std::vector<Index> rows, std::vector<Index> places,
             std::span<const double> weights, const LaplacianSystem& system);

  /// Fits the rotation to the unknowns `x`. Then writes the prescribed displacements of the
  /// handle's vertices to `prescribed`, which has one vector per row.
  void fit(std::span<const double> x, std::span<Eigen::Vector3d> prescribed);

  /// Uses the n x n system as P. Its P^-1 U is valid for every rotation, because P is the same for
  /// x, y and z.
  void respond_by_system();
  /// Uses another matrix as P, and computes P^-1 U at the last fitted rotation. `solve` replaces a
  /// right-hand side by P^-1 times it.
  void respond_by(const std::function<void(std::span<double>)>& solve);

  /// P was factorized at an earlier rotation. These functions rotate the handle's vectors of a
  /// right-hand side to that rotation, and the handle's vectors of the solution back. They do
  /// nothing for the n x n system.
  void rotate_to_factor(std::span<double> b) const;
  void rotate_from_factor(std::span<double> solution) const;

  /// Converts the solution P^-1 b in place to the solution for the matrix P - U K^-1 U'.
  void add_turn(std::span<double> solution) const;

  /// Starts a step along -`direction` from the surface at which the rotation was fitted last.
  void begin_step(std::span<const double> direction);
  /// `x` is the point at `length` along the straight step. Adds the difference between the arc and
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
  std::vector<double> held_;  ///< entries of W for the handle's vertices
  Eigen::Matrix3d rotation_ = Eigen::Matrix3d::Identity();
  /// C: covariance of positions and rotated shape.
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Zero();
  /// Solution of the n x n system for the right-hand side W times the unrotated shape. At the
  /// handle's vertices, it is close to the shape.
  std::vector<double> response_;
  /// U' P^-1 U of the n x n system, unrotated.
  Eigen::Matrix3d response_stiffness_ = Eigen::Matrix3d::Zero();
  /// P^-1 U for another P, column by column; empty: P is the n x n system.
  std::vector<double> columns_;
  Eigen::Matrix3d columns_inverse_ = Eigen::Matrix3d::Zero();  ///< (K - U' P^-1 U)^-1 of `columns_`
  /// The rotation at which `columns_` was computed.
  Eigen::Matrix3d at_columns_ = Eigen::Matrix3d::Identity();
  /// Rotation vector of the full step, in radians.
  Eigen::Vector3d turn_ = Eigen::Vector3d::Zero();
  /// The rotation at the start of the step.
  Eigen::Matrix3d at_step_ = Eigen::Matrix3d::Identity();
};

}  // namespace lapwing
