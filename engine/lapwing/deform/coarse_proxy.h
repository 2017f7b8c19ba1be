#pragma once

#include <memory>
#include <span>
#include <vector>

#include "lapwing/deform/deform_solver_state.h"
#include "lapwing/deform/edit_system.h"
#include "lapwing/deform/predictor.h"
#include "lapwing/elastic/coarse_surfaces.h"
#include "lapwing/elastic/energy_minimizer.h"
#include "lapwing/kernels/cpu_kernels.h"

namespace lapwing {

/// An edit transferred to a decimated surface. Its minimum is close to that of the fine surface,
/// because both energies approximate the same integral (EnergyWeights).
struct CoarseRegion {
  std::shared_ptr<CoarseLevel> level;
  std::unique_ptr<const EditSystem> edit;
};

/// Returns a decimated edit with about `count` vertices in the region. Returns null if the region
/// cannot be decimated (CoarseSurfaces), or if the remaining vertices no longer anchor it.
std::unique_ptr<CoarseRegion> coarse_region(const EditSystem& fine, std::size_t count);

/// Unit: mean edge length. If the last step of a frame is longer than this, the surface is
/// considered to be far from its minimum. The last steps of proxies are 0.0003 to 0.02 in simple
/// motions, and up to 3 if limbs cross or twist.
inline constexpr double kLongStep = 0.05;

/// The coarse proxy of a drag: its edit on a decimated surface of a few thousand vertices. One
/// iteration takes half a millisecond for every size of the region. The drag prolongates the proxy
/// to the fine surface and smooths the result. It then restricts the remaining gradient of the fine
/// surface to the proxy, where it acts as a force. Because of this force, both surfaces reach the
/// same minimum although their energies differ (defect correction; Brandt, Dinar, "Multigrid
/// solutions to elliptic flow problems", 1979).
class CoarseProxy {
 public:
  /// Returns null if no proxy is needed, or if the region cannot be decimated. `fine` must outlive
  /// the object.
  static std::unique_ptr<CoarseProxy> make(const EditSystem& fine);

  /// Starts a drag at the surface with the displacements `u` and the constraints `target`, both of
  /// the fine mesh.
  void begin(const MinimizerTarget& target, std::span<const Eigen::Vector3d> u);

  /// Minimizes the proxy for `target` in four to eight iterations and prolongates the result to
  /// `u`. If the last call ended far from the minimum, the iterations use the Hessian of the pose.
  /// More than four iterations run only if `budget` suffices for another iteration, the
  /// prolongation and the `next_ms` that the caller needs afterwards. If `budget` does not suffice
  /// for `next_ms` even without further iterations, iterations may use that time.
  void step(const MinimizerTarget& target, const TimeBudget& budget, double next_ms,
            std::span<Eigen::Vector3d> u);

  /// Minimizes the proxy for `target` in at most eight iterations. Returns the motions of its
  /// vertices since the last call, which the caller prolongates (CoarseEmbedding).
  std::vector<RowsOfMotion> step(const MinimizerTarget& target);

  /// Minimizes the proxy for `target` until it settles, and prolongates the result to `u`. Throws
  /// Cancelled.
  void settle(const MinimizerTarget& target, const Progress& progress,
              std::span<Eigen::Vector3d> u);

  /// Returns the rotations of the target's free handles after the last call.
  std::vector<Eigen::Matrix3d> handle_rotations() { return minimizer_.handle_rotations(); }

  const CoarseEmbedding& embedding() const { return coarse_->level->embedding; }
  std::size_t vertex_count() const { return surface().kept.size(); }

  /// Restricts the remaining gradient to the proxy, where it acts as a force. `gradient` is half of
  /// the gradient of the fine energy at the displacements `u`; both are per vertex of the fine
  /// mesh.
  void correct(std::span<const Eigen::Vector3d> u, std::span<const Eigen::Vector3d> gradient);

 private:
  static constexpr int kFewestIterations = 4;
  static constexpr int kMostIterations = 8;

  CoarseProxy(const EditSystem& fine, std::unique_ptr<CoarseRegion> coarse);
  const CoarseSurface& surface() const { return coarse_->level->surface; }
  std::vector<Eigen::Vector3d> restricted(std::span<const Eigen::Vector3d> of_fine) const;
  MinimizerTarget target_of(const MinimizerTarget& fine);
  std::vector<Eigen::Vector3d> predicted() const;
  std::vector<Eigen::Vector3d> minimized(const MinimizerTarget& target, const TimeBudget& budget,
                                         double next_ms);
  std::vector<RowsOfMotion> move_to(std::vector<Eigen::Vector3d> displacement);
  CoarseEmbedding::Pose pose_at(std::vector<Eigen::Vector3d> displacement);

  std::unique_ptr<CoarseRegion> coarse_;
  CpuKernels kernels_;
  MinimizerWorkspace workspace_;
  EnergyMinimizer& minimizer_ = workspace_.minimizer;
  double last_step_ = 0.0;        ///< MinimizerResult::last_step of the last frame
  double energy_ratio_;           ///< of the coarse to the fine energy; both are sums over vertices
  std::vector<char> is_held_;     ///< per coarse vertex; true for belt and handles
  std::vector<Index> coarse_of_;  ///< coarse vertex for each vertex of the fine mesh, or kNoIndex

  double prolongation_ms_ = 0.0;

  CoarseEmbedding::Pose pose_;
  std::vector<Eigen::Vector3d> prescribed_;  ///< prescribed displacements at pose_
  Predictor predictor_;
  std::vector<Eigen::Vector3d> forces_;
  // Storage for the spans of the proxy's target.
  std::vector<Eigen::Vector3d> next_prescribed_;
  std::vector<Eigen::Matrix3d> stretch_;
  std::vector<FreeHandle> free_handles_;
};

}  // namespace lapwing
