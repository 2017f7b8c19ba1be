#pragma once

#include <span>
#include <vector>

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>

#include "lapwing/mesh/mesh.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/region/edit_region.h"

namespace lapwing::bench {

/// Smooth ARAP (Oehri, Herholz, Sorkine-Hornung 2025, arXiv 2501.10335). Belt and handles are hard
/// constraints. Minimizes
///
///     E = (1 - lambda) sum_i sum_j w_ij |v'_i - v'_j - R_i (v_i - v_j)|^2
///         + lambda sum_i |L(v')_i - R_i L(v)_i|^2,     L(v)_i = sum_j w_ij (v_i - v_j)
///
/// in alternating steps: each R_i is fitted to the edges of its ring alone, then the positions
/// minimize E. The energy and the fit are the paper's. The weights w_ij of L, the cotangents of the
/// first sum (0 if negative), and the value of `lambda` are our choice. With `lambda` 0 it is ARAP.
class SmoothArap {
 public:
  /// Assembles and factorizes. `mesh` and `region` must outlive the object. Throws SolverError if
  /// the matrix is singular.
  SmoothArap(const Mesh& mesh, const EditRegion& region, double lambda = 0.5);

  /// Moves the handles from rest by `motions`. All other vertices start at rest.
  void move(std::span<const Eigen::Affine3d> motions);
  /// Iterates until the relative change of E is at most `tolerance`, or `most_iterations` times.
  /// Returns the number of iterations.
  int iterate(int most_iterations, double tolerance);

  /// Returns E with the rotations of the last iteration.
  double energy() const;
  Positions positions() const;

 private:
  using Points = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
  using Sparse = Eigen::SparseMatrix<double>;

  void fit_rotations();
  void solve();
  // Calls `visit(i, j, w_ij, v_i - v_j)` for each vertex and each of its neighbours.
  template <class Visit>
  void for_each_edge(const Visit& visit) const;

  const EditRegion& region_;
  const Adjacency& rings_;
  double lambda_;
  Points rest_;
  Points current_;
  std::vector<double> w_;                   // per entry of rings_
  std::vector<Eigen::Matrix3d> rotations_;  // per vertex
  Points details_;                          // R_i L(v)_i, per vertex
  Sparse L_;
  Sparse A_;     // half the Hessian of E with fixed rotations
  Sparse free_;  // a column of the identity per free vertex
  Eigen::SimplicialLDLT<Sparse> factor_;
};

}  // namespace lapwing::bench
