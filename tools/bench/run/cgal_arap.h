#pragma once

#include <memory>
#include <span>

#include <Eigen/Geometry>

#include "lapwing/mesh/topology.h"
#include "lapwing/region/edit_region.h"
#include "run/measure.h"

namespace lapwing::bench {

/// CGAL's variants: as its manual chooses by default (spokes and rims), of the original paper, and
/// with rotations made smooth (SRE-ARAP).
enum class ArapVariant { spokes_and_rims, original, smooth_rotations };

/// CGAL's as-rigid-as-possible deformation of a region; belt and handles are where they should be
/// exactly.
class CgalArap {
 public:
  /// Throws InputError unless the triangles are a manifold, turned one way.
  CgalArap(const Mesh& mesh, const EditRegion& region,
           ArapVariant variant = ArapVariant::spokes_and_rims);
  ~CgalArap();

  /// Weights, assembly and factorization with Eigen: its preprocess(), from anew. Throws
  /// SolverError when that fails.
  void prepare();
  /// Back to the rest pose, prepared as it is.
  void reset();
  /// What the handles are moved by from rest.
  void move(std::span<const Eigen::Affine3d> motions);
  /// From where the surface is, until the energy changes by less than `tolerance` of itself; CGAL's
  /// default is 1e-4, and 0 does all `most_iterations`. Returns how many it took.
  int iterate(int most_iterations, double tolerance = kDefaultTolerance);
  static constexpr double kDefaultTolerance = 1e-4;

  Positions positions() const;

 private:
  struct State;
  template <int kVariant>
  struct StateOf;
  std::unique_ptr<State> state_;
};

struct ArapResult {
  Positions positions;
  int iterations = 0;
  Samples frame;  ///< from the rest pose until it converges
};

/// Deforms from rest, up to `max_iterations`, with CGAL's default tolerance.
ArapResult deform_by_cgal_arap(const Mesh& mesh, const EditRegion& region,
                               std::span<const Eigen::Affine3d> motions, ArapVariant variant,
                               int max_iterations, int repeats);

}  // namespace lapwing::bench
