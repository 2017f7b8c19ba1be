#pragma once

#include <memory>
#include <span>

#include <Eigen/Geometry>

#include "lapwing/mesh/mesh.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/region/edit_region.h"

namespace lapwing::bench {

/// Variants of the energy in CGAL. `spokes_and_rims` is CGAL's default. `original` is the energy of
/// Sorkine and Alexa (2007).
enum class ArapVariant { spokes_and_rims, original };

/// CGAL's as-rigid-as-possible deformation of a region. Belt and handles are hard constraints.
class CgalArap {
 public:
  virtual ~CgalArap() = default;

  /// Computes and factorizes CGAL's system with Eigen (its preprocess()), even if that was done
  /// before. Throws SolverError if it fails.
  virtual void prepare() = 0;
  /// Sets the motions of the handles from rest.
  virtual void move(std::span<const Eigen::Affine3d> motions) = 0;
  /// Iterates from the current surface until the relative energy change is below `tolerance`, or
  /// `most_iterations` times. CGAL's default tolerance is 1e-4; 0 does all iterations. Returns the
  /// number of iterations.
  virtual int iterate(int most_iterations, double tolerance = 1e-4) = 0;
  virtual Positions positions() const = 0;
};

/// Throws InputError unless the triangles form a consistently oriented manifold.
std::unique_ptr<CgalArap> make_cgal_arap(const Mesh& mesh, const EditRegion& region,
                                         ArapVariant variant);

}  // namespace lapwing::bench
