#include "lapwing/elastic/free_rotation.h"

#include <algorithm>
#include <utility>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/QR>

#include "lapwing/base/parallel.h"
#include "lapwing/laplacian/ring_fit.h"
#include "lapwing/laplacian/rotation.h"

namespace lapwing {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// If the stiffness against a rotation is below this fraction of the unstrained stiffness, the
// rotation is not changed. For example, rotations of a handle of one vertex or of collinear
// vertices have no effect.
constexpr double kLeastStiffness = 1e-9;

Vector3d at(std::span<const double> field, Index k) {
  const std::size_t n = field.size() / 3;
  return {field[k], field[n + k], field[2 * n + k]};
}

// Compares up to rounding errors, because rotating a shape back is not exact.
bool are_equal(std::span<const Vector3d> a, std::span<const Vector3d> b) {
  constexpr double kEqualShare = 1e-9;
  return std::ranges::equal(a, b, [](const Vector3d& p, const Vector3d& q) {
    return (p - q).norm() <= kEqualShare * q.norm();
  });
}

// Adds by * v to `x` for every vector v of `field`.
void add_field(const Matrix3d& by, std::span<const double> field, std::span<double> x) {
  constexpr std::size_t kVectorsPerTask = 4096;
  const std::size_t n = field.size() / 3;
  parallel_for(n, kVectorsPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const Vector3d added = by * at(field, static_cast<Index>(k));
      for (std::size_t a = 0; a < 3; ++a) x[a * n + k] += added[static_cast<Eigen::Index>(a)];
    }
  });
}

Matrix3d symmetric(const Matrix3d& m) {
  return 0.5 * (m + m.transpose());
}

}  // namespace

void FreeRotation::place(const FreeHandle& handle, std::vector<Index> rows,
                         std::vector<Index> places, std::span<const double> weights,
                         const LaplacianSystem& system) {
  std::vector<double> held;
  for (const Index k : places) held.push_back(weights[k]);
  const bool is_same = places == places_ && held == held_ &&
                       are_equal(handle.shape, handle_.shape) &&
                       response_.size() == 3 * system.size();
  handle_ = handle;
  rows_ = std::move(rows);
  places_ = std::move(places);
  held_ = std::move(held);
  if (is_same) return;
  const std::size_t n = system.size();
  response_.assign(3 * n, 0.0);
  for (std::size_t k = 0; k < places_.size(); ++k) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      response_[axis * n + places_[k]] =
          held_[k] * handle_.shape[k][static_cast<Eigen::Index>(axis)];
    }
  }
  system.solve_in_elimination_order(response_, 3);
  response_stiffness_.setZero();
  for (std::size_t k = 0; k < places_.size(); ++k) {
    response_stiffness_ += held_[k] * cross_matrix(handle_.shape[k]).transpose() *
                           cross_matrix(at(response_, places_[k]));
  }
}

void FreeRotation::fit(std::span<const double> x, std::span<Vector3d> prescribed) {
  Matrix3d covariance = Matrix3d::Zero();
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const Vector3d from_centre = at(x, places_[k]) - handle_.to_centre[k];
    covariance += held_[k] * from_centre * handle_.shape[k].transpose();
  }
  rotation_ = nearest_rotation(covariance);
  covariance_ = covariance * rotation_.transpose();
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    prescribed[rows_[k]] = handle_.to_centre[k] + rotation_ * handle_.shape[k];
  }
}

void FreeRotation::respond_by_system() {
  columns_.clear();
}

void FreeRotation::respond_by(const std::function<void(std::span<double>)>& solve) {
  const std::size_t n = response_.size() / 3;
  at_columns_ = rotation_;
  columns_.assign(9 * n, 0.0);
  Matrix3d of_columns = Matrix3d::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    const auto column = std::span(columns_).subspan(3 * n * static_cast<std::size_t>(axis), 3 * n);
    for (std::size_t k = 0; k < places_.size(); ++k) {
      const Vector3d turned = held_[k] * Vector3d::Unit(axis).cross(rotation_ * handle_.shape[k]);
      for (std::size_t a = 0; a < 3; ++a) {
        column[a * n + places_[k]] = turned[static_cast<Eigen::Index>(a)];
      }
    }
    solve(column);
    of_columns.col(axis) = torque(column, rotation_);
  }
  columns_inverse_ = inverse_stiffness(of_columns);
}

// Returns U' times a field.
Vector3d FreeRotation::torque(std::span<const double> field, const Matrix3d& R) const {
  Vector3d sum = Vector3d::Zero();
  for (std::size_t k = 0; k < places_.size(); ++k) {
    sum += held_[k] * (R * handle_.shape[k]).cross(at(field, places_[k]));
  }
  return sum;
}

// Returns B' W B.
Matrix3d FreeRotation::unstrained_stiffness() const {
  Matrix3d stiffness = Matrix3d::Zero();
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const Matrix3d arm = cross_matrix(Vector3d(rotation_ * handle_.shape[k]));
    stiffness += held_[k] * arm.transpose() * arm;
  }
  return stiffness;
}

// Returns (K - U' P^-1 U)^-1 at the last fitted rotation; `of_response` is U' P^-1 U.
Matrix3d FreeRotation::inverse_stiffness(const Matrix3d& of_response) const {
  const Matrix3d unstrained = unstrained_stiffness();
  const Matrix3d strained = covariance_.trace() * Matrix3d::Identity() - covariance_;
  const Eigen::SelfAdjointEigenSolver<Matrix3d> tension(symmetric(strained - unstrained));
  const Matrix3d K = unstrained + tension.eigenvectors() *
                                      tension.eigenvalues().cwiseMax(0.0).asDiagonal() *
                                      tension.eigenvectors().transpose();
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(symmetric(K - of_response));
  const double least = kLeastStiffness * unstrained.trace();
  const Vector3d inverse =
      solver.eigenvalues().unaryExpr([&](double value) { return value > least ? 1 / value : 0.0; });
  return solver.eigenvectors() * inverse.asDiagonal() * solver.eigenvectors().transpose();
}

void FreeRotation::turn_handle(const Matrix3d& by, std::span<double> field) const {
  const std::size_t n = field.size() / 3;
  for (const Index k : places_) {
    const Vector3d turned = by * at(field, k);
    for (std::size_t a = 0; a < 3; ++a) field[a * n + k] = turned[static_cast<Eigen::Index>(a)];
  }
}

void FreeRotation::rotate_to_factor(std::span<double> b) const {
  if (!columns_.empty()) turn_handle(at_columns_ * rotation_.transpose(), b);
}

void FreeRotation::rotate_from_factor(std::span<double> solution) const {
  if (!columns_.empty()) turn_handle(rotation_ * at_columns_.transpose(), solution);
}

void FreeRotation::add_turn(std::span<double> solution) const {
  if (columns_.empty()) {
    // P is the same for x, y and z, so the response rotates with the handle.
    const Matrix3d inverse =
        inverse_stiffness(rotation_ * response_stiffness_ * rotation_.transpose());
    const Vector3d turn = inverse * torque(solution, rotation_);
    add_field(cross_matrix(turn) * rotation_, response_, solution);
    return;
  }
  const Vector3d turn = columns_inverse_ * torque(solution, at_columns_);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double* column = columns_.data() + axis * solution.size();
    for (std::size_t i = 0; i < solution.size(); ++i) {
      solution[i] += turn[static_cast<Eigen::Index>(axis)] * column[i];
    }
  }
}

void FreeRotation::begin_step(std::span<const double> direction) {
  at_step_ = rotation_;
  turn_ = -(unstrained_stiffness().completeOrthogonalDecomposition().pseudoInverse() *
            torque(direction, rotation_));
}

void FreeRotation::bend(double length, std::span<double> x) const {
  const Vector3d turn = length * turn_;
  const double angle = turn.norm();
  if (angle == 0.0) return;
  const Matrix3d arc = Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
  add_field((arc - Matrix3d::Identity() - cross_matrix(turn)) * at_step_, response_, x);
}

}  // namespace lapwing
