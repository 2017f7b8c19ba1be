#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <span>

#include "lapwing/deform/deform_options.h"
#include "lapwing/deform/made_aside.h"
#include "lapwing/laplacian/held_factor.h"
#include "lapwing/laplacian/laplacian_system.h"
#include "lapwing/settle/settle.h"

namespace lapwing {

/// The energy's tangent in a pose, as settling uses it: A x I - beta G'G. G_i = F_i^-1 a_i of a
/// ring that has turned by R_i is that at rest, each block turned back by R_i (ENERGY.md section
/// 3), where the ring has kept its shape. Where it has been stretched, F_i F_i' = K_i = tr(S) I - S
/// is larger than at rest, C_i = R_i S: its rotation follows the surface less, and what is under
/// tension resists bending. Directions in which a ring has been crushed keep the K_i of rest, so
/// that the matrix stays positive semidefinite in every pose. Its factor is held in floats, which
/// do for a first Hessian (settle/README.md), and in doubles for a pose at which rounding leaves it
/// indefinite. Takes its memory, half that of another 3n x 3n factor, when it is first turned, or
/// before.
class PoseTangent final : public TurnedTangent {
 public:
  /// Makes, or finds, G at rest over the rings of a region (tangent_rows).
  using AtRest = std::function<std::shared_ptr<const BlockRows>()>;

  /// `topology`, `pattern` and `laplacian` must outlive the object; `laplacian` is the n x n system
  /// with its rings, in whose order transforms come. `at_rest` is asked when it is first turned.
  PoseTangent(const Topology& topology, std::span<const Index> roi, const SystemPattern& pattern,
              const LaplacianSystem& laplacian, const DeformOptions& options, AtRest at_rest);

  /// Begins to take that memory on another thread, for which the first turn waits. May be called
  /// while another thread turns; does nothing if that has taken it.
  void prepare();

  bool turn(std::span<const Eigen::Matrix3d> transforms,
            std::span<const Eigen::Vector3d> displacement) override;
  void solve_in_place(std::span<double> b) override;
  void solve_well_in_place(std::span<double> b) override;

 private:
  std::unique_ptr<HeldFactor> analyzed_factor() const;
  bool fits(const HeldFactor& factor) const;
  bool take_memory();
  HeldFactor& in_use() { return doubles_ != nullptr ? *doubles_ : *factor_; }
  bool is_factored(HeldFactor& factor) const;
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
  std::unique_ptr<HeldFactor> factor_;   ///< in floats
  std::unique_ptr<HeldFactor> doubles_;  ///< null unless the pose at hand needs it
  std::vector<double> b_;  ///< in the order of the unknowns, x, y and z of each together
  std::vector<double> x_;
  bool is_solved_ = false;  ///< x_ is the factor's solution for b_
  std::mutex taking_;       ///< held until factor_ is there, or prepared_ has begun
  MadeAside<std::unique_ptr<HeldFactor>> prepared_;  // last: it uses all the others
};

}  // namespace lapwing
