#pragma once

#include <memory>
#include <span>
#include <vector>

#include "lapwing/deform/coarse_region.h"
#include "lapwing/deform/predictor.h"
#include "lapwing/elastic/energy_minimizer.h"
#include "lapwing/kernels/cpu_kernels.h"

namespace lapwing {

/// A drag's second level: the same edit on a surface of a few thousand vertices, however many there
/// are, which takes a frame a few milliseconds to settle; the fine surface is carried along. That
/// tells how limbs swing and bend, which the fine level alone finds out slowly; the fine level then
/// smooths what carrying left. What pulls on the fine surface afterwards, gathered, is a force on
/// the coarse one from then on, so that both come to rest at the same pose, though the coarse
/// surface is another one (defect correction; Brandt, Dinar, "Multigrid solutions to elliptic flow
/// problems", 1979).
class CoarseProxy {
 public:
  /// Null where no coarse surface is needed, or where the region cannot be made smaller. `fine`
  /// must outlive the object.
  static std::unique_ptr<CoarseProxy> make(const EditSystem& fine);

  /// The fine surface is at `u` for `target`, both of the fine mesh.
  void begin(const MinimizerTarget& target, std::span<const Eigen::Vector3d> u);

  /// Settles the coarse surface for `target` by four to eight iterations and takes `u` along. More
  /// than four are made where `budget` says that there is time for one, for the rest of this call,
  /// and for the `next_ms` that the caller has a use for; or where there is not even time for that
  /// use.
  void move(const MinimizerTarget& target, const TimeBudget& budget, double next_ms,
            std::span<Eigen::Vector3d> u);

  /// Settles the coarse surface for `target` and takes `u` along. Throws Cancelled.
  void settle(const MinimizerTarget& target, const Progress& progress,
              std::span<Eigen::Vector3d> u);

  /// The rotations of the target's free handles, as the last call left them.
  std::vector<Eigen::Matrix3d> handle_rotations() { return settler_.handle_rotations(); }

  /// What the fine level has come to: its surface, and half of the gradient of its energy there,
  /// per vertex of the fine mesh.
  void learn(std::span<const Eigen::Vector3d> u, std::span<const Eigen::Vector3d> gradient);

 private:
  static constexpr int kFewestIterations = 4;
  static constexpr int kMostIterations = 8;

  CoarseProxy(const EditSystem& fine, std::unique_ptr<CoarseRegion> coarse);
  const CoarseSurface& surface() const { return coarse_->level->surface; }
  std::vector<Eigen::Vector3d> of_kept(std::span<const Eigen::Vector3d> of_fine) const;
  MinimizerTarget target_of(const MinimizerTarget& fine);
  std::vector<Eigen::Vector3d> predicted() const;
  void carry_to(std::vector<Eigen::Vector3d> displacement, std::span<Eigen::Vector3d> u);
  CoarseEmbedding::Pose pose_at(std::vector<Eigen::Vector3d> displacement);

  std::unique_ptr<CoarseRegion> coarse_;
  CpuKernels kernels_;
  EnergyMinimizer settler_;
  double energy_ratio_;           ///< of the coarse energy to the fine one: both sum over vertices
  std::vector<char> is_held_;     ///< per coarse vertex: belt or handle
  std::vector<Index> coarse_of_;  ///< per vertex of the fine mesh, or kNoIndex

  double carrying_ms_ = 0.0;  ///< what followed on the iterations last time

  CoarseEmbedding::Pose pose_;
  std::vector<Eigen::Vector3d> wanted_;  ///< for which it was settled last
  Predictor predictor_;
  std::vector<Eigen::Vector3d> forces_;
  // What a target is given by, kept for as long as it is used.
  std::vector<Eigen::Vector3d> next_wanted_;
  std::vector<Eigen::Matrix3d> stretch_;
  std::vector<FreeHandle> free_handles_;
};

}  // namespace lapwing
