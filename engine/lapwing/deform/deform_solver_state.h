#pragma once

#include <memory>
#include <mutex>

#include "lapwing/deform/deform_solver.h"
#include "lapwing/deform/edit_system.h"
#include "lapwing/deform/handle_weights.h"
#include "lapwing/deform/motion_target.h"
#include "lapwing/elastic/energy_minimizer.h"
#include "lapwing/elastic/pose_hessian.h"
#include "lapwing/kernels/cpu_kernels.h"

namespace lapwing {

/// The memory of a minimization. Only one thread may use an object at a time.
struct MinimizerWorkspace {
  MinimizerWorkspace(const EditSystem& edit, Kernels& kernels);
  MinimizerWorkspace(const MinimizerWorkspace&) = delete;
  MinimizerWorkspace& operator=(const MinimizerWorkspace&) = delete;

  PoseHessian hessian;
  EnergyMinimizer minimizer;
};

/// The members of a DeformSolver, which a DragSession also uses.
struct DeformSolverState {
  std::shared_ptr<const EditSystem> edit;
  Kernels* kernels = nullptr;
  CpuKernels cpu;
  Kernels* minimizer_kernels = nullptr;  ///< `kernels` or `cpu`
  StageTimings timings;
  std::unique_ptr<const HandleWeights> weights;    ///< null if the edit does not use rest stretch
  std::shared_ptr<const ResponseSystem> response;  ///< null if the edit settles
  /// Solves the edit in which rigid parts are handles (`with_rigid_handles`); null if there are no
  /// rigid parts.
  std::unique_ptr<const DeformSolver> with_rigid_parts;

  /// Returns the cached workspace, or a new one. Both functions are thread-safe.
  std::shared_ptr<MinimizerWorkspace> take_workspace() const;
  /// Caches `workspace` for the next minimization, unless another workspace is already cached.
  void give_back(std::shared_ptr<MinimizerWorkspace> workspace) const;

 private:
  mutable std::mutex mutex_;
  mutable std::shared_ptr<MinimizerWorkspace> unused_;
};

/// Borrows a workspace for one minimization; the destructor returns it.
class BorrowedWorkspace {
 public:
  explicit BorrowedWorkspace(const DeformSolverState& of)
      : of_(of), workspace_(of.take_workspace()) {}
  ~BorrowedWorkspace() { of_.give_back(std::move(workspace_)); }
  BorrowedWorkspace(const BorrowedWorkspace&) = delete;
  BorrowedWorkspace& operator=(const BorrowedWorkspace&) = delete;

  MinimizerWorkspace* operator->() const { return workspace_.get(); }

 private:
  const DeformSolverState& of_;
  std::shared_ptr<MinimizerWorkspace> workspace_;
};

/// Minimizes the energy over `u`, the displacements of the whole mesh, for `target`, without a
/// coarse proxy. Starts at `pose` plus the linear response to the handles' motion since that pose.
/// If `pose` is null, starts from the handle weights. Sets the rotations of free handles in
/// `target`.
MinimizerResult minimize_from(const DragState* pose, const EditSystem& edit,
                              const HandleWeights& weights, EnergyMinimizer& minimizer,
                              MotionTarget& target, std::span<Eigen::Vector3d> u,
                              const Progress& progress);

}  // namespace lapwing
