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

/// The memory of a minimization. Serves one thread at a time.
struct MinimizerWorkspace {
  MinimizerWorkspace(const EditSystem& edit, Kernels& kernels);
  MinimizerWorkspace(const MinimizerWorkspace&) = delete;
  MinimizerWorkspace& operator=(const MinimizerWorkspace&) = delete;

  PoseHessian hessian;
  EnergyMinimizer minimizer;
};

/// The members of a DeformSolver, which a DragSession uses too.
struct DeformSolverState {
  std::shared_ptr<const EditSystem> edit;
  Kernels* kernels = nullptr;
  CpuKernels cpu;
  Kernels* minimizer_kernels = nullptr;  ///< `kernels` or `cpu`
  StageTimings timings;
  std::unique_ptr<const HandleWeights> weights;    ///< null if the edit takes no rest stretch
  std::shared_ptr<const ResponseSystem> response;  ///< null if the edit settles

  /// Returns the unused workspace, or a new one. Thread-safe, like `give_back`.
  std::shared_ptr<MinimizerWorkspace> take_workspace() const;
  /// Keeps `workspace` for the next minimization, unless another one is kept already.
  void give_back(std::shared_ptr<MinimizerWorkspace> workspace) const;

 private:
  mutable std::mutex mutex_;
  mutable std::shared_ptr<MinimizerWorkspace> unused_;
};

/// Takes a workspace for one minimization and gives it back at the end.
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

/// Minimizes `u`, displacements of the whole mesh, for `target`, without a coarse proxy. Starts at
/// `pose` plus the linear response to the change of the handles since. If `pose` is null, starts at
/// the handle weights. Sets the rotations of free handles in `target`.
MinimizerResult minimize_from(const DragState* pose, const EditSystem& edit,
                              const HandleWeights& weights, EnergyMinimizer& minimizer,
                              MotionTarget& target, std::span<Eigen::Vector3d> u,
                              const Progress& progress);

}  // namespace lapwing
