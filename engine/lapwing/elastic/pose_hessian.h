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
/// preconditioner. Tension increases K_i, and with it the resistance against bending. Under
/// compression, K_i is that of the stretched rest shape, so that the matrix is positive
/// semidefinite at every pose. The matrix is factorized in single precision, which needs half the
/// memory of double precision. If rounding errors make it indefinite at a pose, it is factorized in
/// double precision at that pose. The memory is allocated in `prepare` or in the first
/// factorization.
class PoseHessian final : public Preconditioner {
 public:
  /// Returns G at rest over the rings of a region (tangent_rows).
  using AtRest = std::function<std::shared_ptr<const BlockRows>()>;

  /// `laplacian` is the n x n system. `topology`, `pattern` and `laplacian` must outlive the
  /// object. The first factorization calls `at_rest`.
  PoseHessian(const Topology& topology, std::span<const Index> roi, const SystemPattern& pattern,
              const LaplacianSystem& laplacian, const DeformOptions& options, AtRest at_rest);

  /// Starts to allocate the memory on another thread; the first factorization waits for that
  /// thread. May be called while another thread factorizes. Does nothing if the memory is already
  /// allocated.
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
  std::vector<Index> row_of_;  ///< for each entry of roi_, its row in the rings
  std::shared_ptr<const BlockRows> at_rest_;
  BlockRows turned_;
  std::unique_ptr<ConstrainedFactor> factor_;  ///< in single precision
  /// In double precision; null unless the current pose needs it.
  std::unique_ptr<ConstrainedFactor> doubles_;
  std::vector<double> b_;  ///< in the order of the unknowns; x, y and z of an unknown are adjacent
  std::vector<double> x_;
  bool is_solved_ = false;  ///< true if x_ is the factor's solution for b_
  std::mutex taking_;       ///< locked until factor_ exists or prepared_ has begun
  // Last member, because it uses the others.
  BackgroundTask<std::unique_ptr<ConstrainedFactor>> prepared_;
};

}  // namespace lapwing
