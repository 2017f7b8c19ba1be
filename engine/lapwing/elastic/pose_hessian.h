#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <span>

#include "lapwing/elastic/background_task.h"
#include "lapwing/elastic/deform_options.h"
#include "lapwing/elastic/energy_minimizer.h"
#include "lapwing/laplacian/constrained_factor.h"
#include "lapwing/laplacian/laplacian_system.h"

namespace lapwing {

/// The Hessian of the energy at a pose, A x I - beta G'G (ENERGY.md section 5), as a
/// preconditioner. Under tension, a ring resists bending. Under compression, K_i is that of the
/// stretched rest shape, so that the matrix is positive semidefinite at every pose. The matrix is
/// factored in single precision, which takes half the memory of a 3n x 3n factor in double
/// precision. If rounding errors make it indefinite at a pose, it is factored in double precision
/// there. The memory is allocated in `prepare` or in the first factorization.
class PoseHessian final : public Preconditioner {
 public:
  /// Finds G at rest over the rings of a region (tangent_rows).
  using AtRest = std::function<std::shared_ptr<const BlockRows>()>;

  /// `topology`, `pattern` and `laplacian`, the n x n system, must outlive the object. `at_rest` is
  /// called at the first factorization.
  PoseHessian(const Topology& topology, std::span<const Index> roi, const SystemPattern& pattern,
              const LaplacianSystem& laplacian, const DeformOptions& options, AtRest at_rest);

  /// Starts to allocate the memory on another thread, for which the first factorization waits. May
  /// be called while another thread factors, and does nothing if the memory exists already.
  void prepare();

  bool factorize(std::span<const Eigen::Matrix3d> transforms,
                 std::span<const Eigen::Vector3d> displacement) override;
  void solve_in_place(std::span<double> b) override;
  void solve_accurately_in_place(std::span<double> b) override;

 private:
  std::unique_ptr<ConstrainedFactor> analyzed_factor() const;
  bool fits(const ConstrainedFactor& factor) const;
  bool take_memory();
  ConstrainedFactor& in_use() { return doubles_ != nullptr ? *doubles_ : *factor_; }
  bool is_factored(ConstrainedFactor& factor) const;
  bool factor_in_doubles();
  bool read(std::span<const double> b);
  void write(std::span<double> b) const;
  void refine();

  const Topology& topology_;
  const SystemPattern& pattern_;
  const LaplacianSystem& laplacian_;
  AtRest make_at_rest_;
  std::size_t memory_limit_;
  std::vector<Index> roi_;
  std::vector<Index> row_of_;  ///< place in roi_ -> row of the rings
  std::shared_ptr<const BlockRows> at_rest_;
  BlockRows turned_;
  std::unique_ptr<ConstrainedFactor> factor_;   ///< in floats
  std::unique_ptr<ConstrainedFactor> doubles_;  ///< null unless the current pose needs it
  std::vector<double> b_;  ///< in the order of the unknowns, x, y and z of each together
  std::vector<double> x_;
  bool is_solved_ = false;  ///< x_ is the factor's solution for b_
  std::mutex taking_;       ///< held until factor_ exists or prepared_ has begun
  BackgroundTask<std::unique_ptr<ConstrainedFactor>> prepared_;  // last: it uses all the others
};

}  // namespace lapwing
