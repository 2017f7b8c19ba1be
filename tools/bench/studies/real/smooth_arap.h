#pragma once

#include <span>
#include <vector>

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>

#include "lapwing/mesh/mesh.h"
#include "lapwing/region/edit_region.h"

namespace lapwing::bench {

/// Smooth ARAP (Oehri, Herholz, Sorkine-Hornung 2025, arXiv 2501.10335), of a region whose belt and
/// handles are where they should be exactly:
///
///     E = (1 - lambda) sum_i sum_j w_ij |p'_i - p'_j - R_i (p_i - p_j)|^2
///         + lambda sum_i |L p'_i - R_i L p_i|^2,     L p_i = sum_j w_ij (p_i - p_j)
///
/// w_ij are cotangents, those below zero taken as zero. By turns the rotations are fitted to edges
/// alone and the positions minimize E. `lambda` is 0 for ARAP; the authors leave the choice to the
/// user, and say that it depends on the mesh.
class SmoothArap {
 public:
  /// Weights, assembly and factorization. `mesh` and `region` must outlive it. Throws SolverError
  /// when the factorization fails.
  SmoothArap(const Mesh& mesh, const EditRegion& region, double lambda);

  /// What the handles are moved by from rest; the other vertices start where they are.
  void move(std::span<const Eigen::Affine3d> motions);
  /// From where the surface is, until E changes by less than `tolerance` of itself. Returns how
  /// many iterations it took.
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
  std::vector<Eigen::Index> unknown_;        ///< per vertex of the mesh; -1 where it is held
  Eigen::SparseMatrix<double> matrix_;       ///< a row per unknown, a column per vertex
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor_;
  Positions positions_;
};

}  // namespace lapwing::bench
