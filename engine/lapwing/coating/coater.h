#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/stopwatch.h"
#include "lapwing/coating/coating.h"
#include "lapwing/kernels/kernels.h"
#include "lapwing/laplacian/weights.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/parameterize/patch.h"
#include "lapwing/region/transition.h"

namespace lapwing {

struct CoaterOptions {
  LaplacianWeights weights = LaplacianWeights::cotangent;
  Transition transition;
  /// Waves longer than this follow the coating's displacement rather than its Laplacians. 0: all
  /// waves follow the Laplacians. See Coater.
  double hold_length = 0.0;
  /// Per vertex of the target patch, in place of `hold_length`; empty: `hold_length`.
  std::vector<double> hold_lengths = {};
};

/// A vertex with a prescribed displacement.
struct HeldVertex {
  Index vertex = 0;
  Eigen::Vector3d displacement = Eigen::Vector3d::Zero();
};

/// The surface to coat, over the whole mesh.
struct CoatTarget {
  std::span<const Eigen::Vector3d> rest;  ///< U
  /// U smooth, which defines the frames. The detail of U over it is removed; empty keeps it.
  std::span<const Eigen::Vector3d> smooth = {};
  /// Removes all of U inside the patch, not only its detail: xi_U = delta(U). The result has the
  /// shape of the layers, between the borders, which stay (paper section 5.3).
  bool whole = false;
  /// Anchors and handles inside the patch, held with the paper's weight 1 in the same solve. The
  /// surface follows them up to its border, whatever the hold length. Ascending by vertex; those on
  /// the border stay.
  std::span<const HeldVertex> held = {};
};

/// A horn or a leg fills very little of the domain, so that the edges at its tip can be many times
/// as long as their images on the source. A coating scaled by that ratio would be useless. See
/// CoatOptions::scale.
inline constexpr double kLargestLocalScale = 4.0;

/// How a coating is transferred.
struct CoatOptions {
  /// See sample_coating. With either, a surface gets its own coating back.
  MappedSampling sampling = MappedSampling::one_ring;
  /// Size of the coating on the target over that on the source. Default: the local ratio of edge
  /// lengths, at most kLargestLocalScale times that of the whole patches.
  std::optional<double> scale;
  bool operator==(const CoatOptions&) const = default;
};

/// A coating to put on a target patch.
struct CoatLayer {
  const Coating& coating;
  std::span<const SurfacePoint>
      points;  ///< per own number of the target patch: point on the coating
  CoatOptions options = {};
  std::span<const double> weights = {};  ///< per vertex of the target patch; empty: 1 everywhere
};

/// The scales s of one layer's frames on the target.
struct LayerScales {
  double mean = 0.0;
  std::size_t held = 0;  ///< vertices at which s was limited to kLargestLocalScale
};

/// Puts coatings on a target patch (paper sections 5.1 and 5.2). Solves for the displacement u of
/// the target U
///     (L'L + W) u = L' f (a T xi - xi_U) + W f (a T d - (U - U smooth))
/// on one n x n factor. a is the amplitude, f the transition's share, d the coating's displacement
/// and xi its Laplacians at the target's vertices (sample_coating). T = s R maps the source's frame
/// to that of U smooth, and xi_U = delta(U) - delta(U smooth). The boundary loop is held exactly;
/// nothing outside the patch moves. W = (pi r / hold_length)^4, with r the ring's radius, outweighs
/// L'L for waves longer than hold_length. Rotated Laplacians are no longer those of any surface.
/// Without W the inconsistency would add up to a bulge as wide as the patch.
///
///     Coater coater({positions, smooth}, topology, patch, options, kernels);  // factors
///     coater.take(coating, points, {});                                       // one solve
///     Positions coated = coater.coat(1.0);                                    // no solve
class Coater {
 public:
  /// Stages reported and timed: "order", "laplacian", "target_frames". `target.rest` and `kernels`
  /// must outlive the object. Throws InputError if the patch has no inner vertex or does not
  /// contain a held one, and SolverError if the system is singular.
  Coater(const CoatTarget& target, const Topology& topology, const Patch& patch,
         const CoaterOptions& options, Kernels& kernels, const Progress& progress = {});
  ~Coater();
  Coater(Coater&&) noexcept;
  Coater& operator=(Coater&&) noexcept;

  /// Samples, rotates and solves for the sum of `layers`, each times its weights (paper section
  /// 5.3). Replaces the layers taken before. Stages "frames", "sample", "solve".
  void take(std::span<const CoatLayer> layers, const Progress& progress = {});
  /// The same for one coating.
  void take(const Coating& coating, std::span<const SurfacePoint> points,
            const CoatOptions& options, const Progress& progress = {}) {
    const CoatLayer layer{coating, points, options};
    take(std::span(&layer, 1), progress);
  }

  /// Returns the whole target with `amplitude` times the coating. 0 gives the target (smooth if
  /// requested), a negative amplitude engraves. Linear in the amplitude, without a solve.
  Positions coat(double amplitude) const;

  /// Scales of the layers taken last, in their order.
  const std::vector<LayerScales>& scales() const;
  /// Returns the largest share of a coating that the transition lets through, 0 to 1.
  double largest_share() const;
  /// |A u - b| / |b| of the coating's system.
  double relative_residual() const;
  const VertexSet& free() const;
  const StageTimings& timings() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Returns the share of `transition` at each vertex of `patch`, midpoints excepted, by the geodesic
/// distance within the patch from its boundary loop.
std::vector<double> fades(const Transition& transition, const Patch& patch,
                          const Topology& topology, std::span<const Eigen::Vector3d> positions);

}  // namespace lapwing
