#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "lapwing/base/progress.h"
#include "lapwing/base/stopwatch.h"
#include "lapwing/coating/patch_coating.h"
#include "lapwing/kernels/kernels.h"
#include "lapwing/laplacian/weights.h"
#include "lapwing/region/transition.h"

namespace lapwing {

struct CoaterOptions {
  LaplacianWeights weights = LaplacianWeights::cotangent;
  Transition transition;
  /// Waves longer than this come from where the coating's displacement would put the surface rather
  /// than from its Laplacians; 0: everything from the Laplacians. See Coater.
  double hold_length = 0.0;
  /// Per vertex of the target patch, in place of the one; empty: the one.
  std::vector<double> hold_lengths = {};
};

/// A vertex that should be somewhere else, by how much.
struct HeldVertex {
  Index vertex = 0;
  Eigen::Vector3d displacement = Eigen::Vector3d::Zero();
};

/// The surface to coat, both over the whole mesh.
struct CoatTarget {
  std::span<const Eigen::Vector3d> rest;  ///< U
  /// U smooth: what U has over it goes, and the frames are its. Empty keeps all of U.
  std::span<const Eigen::Vector3d> smooth = {};
  /// All of U inside the patch goes, not only what it has over U smooth: xi_U = delta(U). Its shape
  /// is then that of what comes, between the borders that stay (paper section 5.3).
  bool whole = false;
  /// Anchors and handles inside the patch, held by the paper's weight 1 in the same solve. The
  /// surface follows them as far as its border, whatever the hold length. Ascending by vertex;
  /// those on the border stay there.
  std::span<const HeldVertex> held = {};
};

/// A horn or a leg is laid on next to nothing of the domain, so that the edges at its tip can be
/// any number of times as long as what they come to lie on, and a coating that much larger is none
/// any more. See CoatOptions::scale.
inline constexpr double kLargestLocalScale = 4.0;

/// How a coating is taken over.
struct CoatOptions {
  /// See sample_coating; with both a surface gets its own coating back.
  MappedSampling sampling = MappedSampling::one_ring;
  /// Its size on the target over that on the source; none: the local ratio of edge lengths, held to
  /// kLargestLocalScale times that of the patches as wholes.
  std::optional<double> scale;
  bool operator==(const CoatOptions&) const = default;
};

/// One coating on its way to a target patch.
struct CoatLayer {
  const Coating& coating;
  std::span<const SurfacePoint>
      points;  ///< per own number of the target: where it lies on the coating
  CoatOptions options = {};
  std::span<const double> weights = {};  ///< per vertex of the target patch; empty: 1 everywhere
};

/// How the frames of one layer came out on the target: s over the patch.
struct LayerScales {
  double mean = 0.0;
  std::size_t held = 0;  ///< vertices at which s was held to kLargestLocalScale
};

/// Puts coatings on a target patch (paper sections 5.1 and 5.2). With u the displacement of the
/// target U, f the transition's share, xi the coating's Laplacians at the target's vertices (see
/// sample_coating), T = s R from the source's frame to that of U smooth, and
/// xi_U = delta(U) - delta(U smooth):
///     (L'L + W) u = L' f (a T xi - xi_U) + W f (a T d - (U - U smooth))
/// on one n x n factor, a the amplitude. The boundary loop is held exactly; nothing outside the
/// patch moves. d is the coating's displacement, and W = (pi r / hold_length)^4, r the ring's
/// radius, which outweighs L'L for waves longer than hold_length: Laplacians that are turned with
/// the surface they come to are no longer those of any surface, and without W what does not fit
/// adds up to a bulge as wide as the patch.
///
///     Coater coater({positions, smooth}, topology, patch, options, kernels);  // factors
///     coater.take(coating, points, {});                                       // one solve
///     Positions coated = coater.coat(1.0);                                    // as often as
///     wanted
class Coater {
 public:
  /// Stages reported and timed: "order", "laplacian", "target_frames". What
  /// `target.rest` points to and `kernels` must outlive the object. Throws InputError when the
  /// patch has no inner vertex or lacks one that is to be held, SolverError when the system is
  /// singular.
  Coater(const CoatTarget& target, const Topology& topology, const Patch& patch,
         const CoaterOptions& options, Kernels& kernels, const Progress& progress = {});
  ~Coater();
  Coater(Coater&&) noexcept;
  Coater& operator=(Coater&&) noexcept;

  /// Samples, turns and solves for the sum of `layers`, each times its weights (paper section 5.3),
  /// which replaces what was taken before. Stages "frames", "sample", "solve".
  void take(std::span<const CoatLayer> layers, const Progress& progress = {});
  /// For one coating.
  void take(const Coating& coating, std::span<const SurfacePoint> points,
            const CoatOptions& options, const Progress& progress = {}) {
    const CoatLayer layer{coating, points, options};
    take(std::span(&layer, 1), progress);
  }

  /// The whole target with `amplitude` times the coating: 0 gives the target (smooth, where that
  /// was asked for), negative engraves. Linear in the amplitude; no solve.
  Positions coat(double amplitude) const;

  /// Of the layers taken last, in their order.
  const std::vector<LayerScales>& scales() const;
  /// The most of a coating that the transition lets through anywhere, 0 to 1.
  double largest_share() const;
  /// |A u - b| / |b| of the coating's system.
  double relative_residual() const;
  const VertexSet& free() const;
  const StageTimings& timings() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace lapwing
