#pragma once

#include <memory>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/stopwatch.h"
#include "lapwing/deform/handle_motion.h"
#include "lapwing/deform/modifiers/loose_parts.h"
#include "lapwing/elastic/deform_options.h"
#include "lapwing/elastic/factor_cache.h"
#include "lapwing/elastic/prepared_region.h"
#include "lapwing/laplacian/constraints.h"
#include "lapwing/region/edit_region.h"

namespace lapwing {

/// The largest allowed motion of a handle or target, divided by the size of the region. At this
/// distance, positions are rounded to 2e-9 of the region's size, which preserves the surface's
/// shape.
inline constexpr double kFarthestMove = 1e7;

/// A prepared edit, shared by its preview, its solver and its drags. Does not change after
/// construction.
struct EditSystem {
  /// Reports the stages "pattern" and "order", or "constraints" if `prepared` contains both, and
  /// then "laplacian". Throws the errors of DeformSolver's constructor.
  EditSystem(PreparedRegion& prepared, std::span<const Eigen::Vector3d> rest_positions,
             EditRegion edit_region, const DeformOptions& deform_options, const Progress& progress,
             bool is_previewed = false);

  std::shared_ptr<const Positions> rest;
  const Topology& topology;
  EditRegion region;
  DeformOptions options;
  StageTimings timings;
  double size = 0.0;                ///< of the region and its rings (require_extent)
  std::vector<HandleFrame> frames;  ///< per handle
  Constraints constraints;
  /// Of the soft targets; null if there are none.
  std::shared_ptr<const std::vector<Spring>> springs;
  std::shared_ptr<FactorCache> factors;              ///< shared by all edits with these unknowns
  std::shared_ptr<const LaplacianSystem> laplacian;  ///< factored
  LooseParts loose;                                  ///< of the region
  /// The vertices that a motion can displace: the unknowns, handle vertices, vertex targets and
  /// loose parts.
  std::vector<Index> moving;

  /// Returns G at rest (FactorCache::tangent_rows).
  std::shared_ptr<const BlockRows> tangent_rows(Kernels& kernels) const;
  /// Returns the factorized 3n x 3n system (FactorCache::response).
  std::shared_ptr<const ResponseSystem> response(Kernels& kernels, const Progress& progress,
                                                 StageTimings& stages) const;

  std::size_t column_count() const { return kMotionParameters * region.handles.size(); }

  /// Sets the column_count() parameters for `motions`, one per handle. Throws InputError if the
  /// number of motions is wrong, or if a motion exceeds kFarthestMove.
  void set_parameters(std::span<const Eigen::Affine3d> motions, std::span<double> parameters) const;
  /// Sets only the parameters of `handles`, one handle after the other.
  void set_parameters(std::span<const Eigen::Affine3d> motions,
                      std::span<const std::size_t> handles, std::span<double> parameters) const;

  /// Returns true if only handles constrain the region: it has no belt, no target and no neighbour
  /// outside.
  bool is_held_by_handles_alone() const;

  std::vector<std::size_t> all_handles() const;

  /// Returns true if handles that scale stretch the rest shape of the surface. With the RSI system,
  /// they do so only if the edit settles.
  bool takes_rest_stretch() const {
    return options.settle || options.response == LinearResponse::tangent;
  }

  /// Returns true if the edit settles and its region is too large to minimize in a frame without a
  /// coarse proxy.
  bool needs_coarse_surface() const;

  /// Returns the displacements that the handles prescribe, per vertex of the mesh. They are 0
  /// except at the vertices of handles and at the anchors of loose parts. The cost is linear in the
  /// number of handle vertices if `reused` is the result of an earlier call.
  std::vector<Eigen::Vector3d> displacement_of_handles(
      std::span<const double> parameters, std::vector<Eigen::Vector3d> reused = {}) const;
  /// Like displacement_of_handles, but includes the displacements that hard targets prescribe.
  std::vector<Eigen::Vector3d> prescribed_displacement(
      std::span<const double> parameters, std::vector<Eigen::Vector3d> reused = {}) const;

  /// Calls visit(handle, vertex) for each vertex whose displacement a handle prescribes.
  template <typename Visit>
  void for_prescribed(const Visit& visit) const {
    for (std::size_t h = 0; h < frames.size(); ++h) {
      for (const Index v : region.handles[h]) visit(h, v);
    }
    for (const FalloffVertex& graded : region.graded) visit(graded.handle, graded.vertex);
    for (const LoosePart& part : region.loose) {
      for (const LooseAnchor& anchor : part.anchors) {
        if (anchor.handle < frames.size()) visit(anchor.handle, anchor.vertex);
      }
    }
  }

 private:
  SystemTerms terms() const;
  void require_motions(std::size_t count) const;
  void require_near(double distance, const char* what, std::size_t number) const;
  void set_parameters(std::size_t handle, const Eigen::Affine3d& motion,
                      std::span<double> parameters) const;
  void check_and_frame();
  void require_memory_to_settle(std::size_t factor_bytes) const;
  void make_springs();
};

}  // namespace lapwing
