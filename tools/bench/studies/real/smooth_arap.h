#pragma once

#include <span>
#include <vector>

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>

#include "lapwing/mesh/mesh.h"
#include "lapwing/region/edit_region.h"

namespace lapwing::bench {

/// Smooth ARAP (Oehri, Herholz, Sorkine-Hornung 2025, arXiv 2501.10335) with hard constraints for
/// belt and handles. Minimizes
///
///     E = (1 - lambda) sum_i sum_j w_ij |p'_i - p'_j - R_i (p_i - p_j)|^2
///         + lambda sum_i |L p'_i - R_i L p_i|^2,     L p_i = sum_j w_ij (p_i - p_j)
///
/// by alternating steps: the rotations are fitted to edges alone, then the positions minimize E.
/// The energy and the rotations are the paper's. The weights of L, the cotangents w_ij (0 if
/// negative) as in the first sum, and the values of `lambda` are our choice. With `lambda` 0 it is
/// ARAP.
class SmoothArap {
 public:
  /// Computes the weights, assembles and factors. `mesh` and `region` must outlive it. Throws
  /// SolverError if the factorization fails.
  SmoothArap(const Mesh& mesh, const EditRegion& region, double lambda);

  /// Moves the handles from rest by `motions`. All other vertices start at rest.
  void move(std::span<const Eigen::Affine3d> motions);
  /// Iterates until E changes by less than `tolerance` times itself. Returns the number of
  /// iterations.
  int iterate(int most_iterations, double tolerance);

  double energy() const;  ///< with the rotations of the last iteration
  const Positions& positions() const { return positions_; }

 private:
  struct Edge {
    Index to = 0;
    double weight = 0.0;
  };
  void fit_rotations();
  void solve();

  const Mesh& mesh_;
  const EditRegion& region_;
  double lambda_;
  std::vector<std::vector<Edge>> edges_;     ///< of the ROI's vertices
  std::vector<Eigen::Vector3d> laplacians_;  ///< at rest, of the ROI's vertices
  std::vector<Eigen::Matrix3d> rotations_;   ///< of the ROI's vertices
  std::vector<Eigen::Index> unknown_;        ///< per vertex of the mesh; -1 if held
  Eigen::SparseMatrix<double> matrix_;       ///< a row per unknown, a column per vertex
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor_;
  Positions positions_;
};

}  // namespace lapwing::bench
