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
  /// Waves longer than this follow the displacement of the coating instead of its Laplacians; if 0,
  /// all waves follow the Laplacians. See Coater.
  double hold_length = 0.0;
  /// One length per vertex of the target patch. If not empty, it replaces `hold_length`.
  std::vector<double> hold_lengths = {};
};

/// A vertex with a prescribed displacement.
struct HeldVertex {
  Index vertex = 0;
  Eigen::Vector3d displacement = Eigen::Vector3d::Zero();
};

/// The surface to coat, as positions of the whole mesh.
struct CoatTarget {
  std::span<const Eigen::Vector3d> rest;  ///< U
  /// The smooth version of U, which defines the frames. The detail of U is removed. If empty, U
  /// keeps its detail.
  std::span<const Eigen::Vector3d> smooth = {};
  /// Removes the whole shape of U inside the patch, not only its detail: xi_U = delta(U). The
  /// result then has the shape of the layers inside the fixed border (paper section 5.3).
  bool whole = false;
  /// Anchors and handles inside the patch: soft constraints with the paper's weight 1 in the same
  /// solve. They also move waves longer than the hold length. Ascending by vertex. Vertices on the
  /// border remain fixed.
  std::span<const HeldVertex> held = {};
};

/// Limit of CoatOptions::scale relative to the patches. A horn or a leg covers very little of the
/// domain, so edges at its tip can be many times longer than their images on the source. A coating
/// with this scale would be useless.
inline constexpr double kLargestLocalScale = 4.0;

struct CoatOptions {
  /// See sample_coating. Both modes reproduce a surface that is coated with its own coating.
  MappedSampling sampling = MappedSampling::one_ring;
  /// Scale factor from the source to the target. By default, the local ratio of edge lengths, at
  /// most kLargestLocalScale times the ratio of the whole patches.
  std::optional<double> scale;
  bool operator==(const CoatOptions&) const = default;
};

/// A coating to transfer to a target patch.
struct CoatLayer {
  const Coating& coating;
  std::span<const SurfacePoint>
      points;  ///< by local index of the target patch: its point on the coating
  CoatOptions options = {};
  std::span<const double> weights = {};  ///< per vertex of the target patch; empty means 1
};

/// The scales s of one layer's frames on the target.
struct LayerScales {
  double mean = 0.0;
  std::size_t held = 0;  ///< number of vertices at which s was limited by kLargestLocalScale
};

/// Transfers coatings to a target patch (paper sections 5.1 and 5.2). Solves for the displacement u
/// of the target U
///     (L'L + W) u = L' f (a T xi - xi_U) + W f (a T d - (U - U smooth))
/// with one factor of an n x n matrix. a is the amplitude, f the value of the transition, d the
/// displacement of the coating and xi its Laplacians at the target's vertices (sample_coating). T =
/// s R maps the source's frame to the frame of U smooth, and xi_U = delta(U) - delta(U smooth). The
/// boundary loop and all vertices outside the patch are fixed. W = (pi r / hold_length)^4, where r
/// is the radius of the one-ring, dominates L'L for wavelengths above hold_length. Without W, the
/// patch would bulge, because rotated Laplacians are in general not the Laplacians of a surface.
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

  /// Samples and rotates the Laplacians of `layers`, and solves for their weighted sum (paper
  /// section 5.3). Replaces the layers of earlier calls. Stages "frames", "sample", "solve".
  void take(std::span<const CoatLayer> layers, const Progress& progress = {});
  void take(const Coating& coating, std::span<const SurfacePoint> points,
            const CoatOptions& options, const Progress& progress = {}) {
    const CoatLayer layer{coating, points, options};
    take(std::span(&layer, 1), progress);
  }

  /// Returns the positions of the whole mesh with `amplitude` times the coating. 0 is the target
  /// (smooth if requested); a negative amplitude engraves. Linear in the amplitude; needs no solve.
  Positions coat(double amplitude) const;

  /// Returns the scales of the current layers, in their order.
  const std::vector<LayerScales>& scales() const;
  /// Returns the largest value of the transition at the target's vertices, 0 to 1.
  double largest_share() const;
  /// Returns |A u - b| / |b| of the last solve.
  double relative_residual() const;
  const VertexSet& free() const;
  const StageTimings& timings() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Returns the value of `transition` at each vertex of `patch` except midpoints. It depends on the
/// geodesic distance within the patch from the boundary loop.
std::vector<double> fades(const Transition& transition, const Patch& patch,
                          const Topology& topology, std::span<const Eigen::Vector3d> positions);

}  // namespace lapwing
