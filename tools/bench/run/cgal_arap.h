#pragma once

#include <memory>
#include <span>

#include <Eigen/Geometry>

#include "lapwing/mesh/topology.h"
#include "lapwing/region/edit_region.h"
#include "run/measure.h"

namespace lapwing::bench {

/// CGAL's variants: its default (spokes and rims), the original paper's, and the one with smooth
/// rotations (SRE-ARAP).
enum class ArapVariant { spokes_and_rims, original, smooth_rotations };

/// CGAL's as-rigid-as-possible deformation of a region. Belt and handles are hard constraints.
class CgalArap {
 public:
  /// Throws InputError unless the triangles form a consistently oriented manifold.
  CgalArap(const Mesh& mesh, const EditRegion& region,
           ArapVariant variant = ArapVariant::spokes_and_rims);
  ~CgalArap();

  /// Computes and factorizes CGAL's system with Eigen (its preprocess()), even if that was done
  /// before. Throws SolverError if it fails.
  void prepare();
  /// Returns to the rest pose and keeps the factorization.
  void reset();
  /// Sets the motions of the handles from rest.
  void move(std::span<const Eigen::Affine3d> motions);
  /// Iterates from the current surface until the relative energy change is below `tolerance`, or
  /// `most_iterations` times. CGAL's default tolerance is 1e-4; 0 does all iterations. Returns the
  /// number of iterations.
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
  Samples frame;  ///< from the rest pose until convergence
};

/// Deforms from rest in at most `max_iterations`, with CGAL's default tolerance.
ArapResult deform_by_cgal_arap(const Mesh& mesh, const EditRegion& region,
                               std::span<const Eigen::Affine3d> motions, ArapVariant variant,
                               int max_iterations, int repeats);

}  // namespace lapwing::bench
