#pragma once

#include <memory>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "lapwing/parameterize/symmetric_dirichlet.h"
#include "lapwing/parameterize/warp.h"
#include "lapwing/solve/block_solver.h"

namespace lapwing {

/// Projected Newton steps on the symmetric Dirichlet energy of a triangulation with some fixed
/// vertices, plus springs from the pulled vertices to their targets:
///     E(x) + stiffness / 2 sum |x_pull - target|^2.
class PlanarNewton {
 public:
  PlanarNewton(std::span<const Triangle> triangles, std::span<const Eigen::Vector2d> rest,
               std::span<const char> is_held);
  PlanarNewton(PlanarNewton&&) = delete;  // the matrix and the solver point to the pattern

  /// Takes one step from `points`, which must be bijective and remain so. The line search starts
  /// just below the step that flattens a triangle (Smith and Schaefer 2015, §3.3). Returns the
  /// relative decrease of the objective, or 0 if no step decreases it.
  double step(std::span<const PointPull> pulls, double stiffness,
              std::vector<Eigen::Vector2d>& points);

 private:
  /// Indices of the 2 x 2 block of two vertices in the value array: the first entry of each column.
  /// Only the lower triangle of a diagonal block is stored.
  struct BlockPlace {
    std::size_t first = 0;
    std::size_t second = 0;
  };
  BlockPlace place(Index row, Index column) const;
  void make_pattern();
  void assemble(std::span<const PointPull> pulls, double stiffness,
                std::span<const Eigen::Vector2d> points);
  void add_part(const Triangle& triangle, const SymmetricDirichlet::Part& part);
  double objective(std::span<const PointPull> pulls, double stiffness,
                   std::span<const Eigen::Vector2d> points) const;

  std::span<const Triangle> triangles_;
  SymmetricDirichlet energy_;
  std::vector<Index> unknown_of_vertex_;  ///< kNoIndex if held
  std::size_t unknowns_ = 0;
  BlockPattern pattern_;  ///< scalar pattern: unknown u has rows 2u and 2u + 1
  BlockMatrix hessian_;
  std::vector<double> gradient_;
  std::vector<SymmetricDirichlet::Part> parts_;
  std::unique_ptr<BlockSolver> solver_;
};

}  // namespace lapwing
