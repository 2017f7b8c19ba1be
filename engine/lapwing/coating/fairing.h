#pragma once

#include <memory>
#include <span>
#include <vector>

#include "lapwing/laplacian/normal_matrix.h"
#include "lapwing/laplacian/system_pattern.h"
#include "lapwing/laplacian/weights.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/region/submesh.h"
#include "lapwing/solve/block_solver.h"

namespace lapwing {

/// Implicit fairing (Desbrun et al. 1999) of a region, with its amount given as a length. The
/// smooth surface x minimizes
///     sum_i m_i |x_i - v_i|^2 + t^2 sum_i m_i |(D x)_i|^2,   t = (length / 2 pi)^2,
/// with D the Laplace operator of the surface and m_i the area around vertex i. This is one
/// implicit step of the bi-Laplacian, (I + t^2 D^2) x = v. A wave of length w keeps
/// 1 / (1 + (length/w)^4) of its height: half at w = length, 6% at half of it, 94% at twice. The
/// border is held: vertices of the region with a neighbour outside it or on the mesh's boundary do
/// not move.
///
/// Both weight schemes measure in lengths: (D x)_i = sum_j s_ij (x_i - x_j) / m_i with
/// m_i = sum_j s_ij |e_ij|^2 / 4, which is exact for |x|^2 on any ring. For cotangents s_ij this is
/// the cotangent operator over Voronoi areas, for s_ij = 1 the umbrella operator over the ring's
/// extent.
class Fairing {
 public:
  /// Analyzes the system, in linear time except for the ordering. `positions` and `topology` must
  /// outlive the object.
  Fairing(std::span<const Eigen::Vector3d> positions, const Topology& topology,
          const VertexSet& region, LaplacianWeights weights);

  /// Returns the positions of the whole mesh with the region smooth. Factors an n x n system.
  /// Throws InputError, naming `where`, if `length` is not above 0.
  Positions smooth(double length, const char* where = "detail_size") const {
    return smooth(positions_, length, where);
  }
  /// The same for other positions of the mesh, with the areas and angles of the first. For
  /// positions whose areas and angles are useless.
  Positions smooth(std::span<const Eigen::Vector3d> other, double length,
                   const char* where = "detail_size") const;

  /// The vertices that move.
  const VertexSet& free() const { return unknowns_.vertices; }

 private:
  std::span<const Eigen::Vector3d> positions_;
  Unknowns unknowns_;
  std::vector<double> masses_;  ///< per unknown
  BlockRows rows_;              ///< D, each row times the root of its mass
  std::unique_ptr<SystemPattern> pattern_;
  std::unique_ptr<BlockSolver> solver_;  ///< analyzed
};

/// A faired region with its surroundings, on a separate mesh. Fairing holds a border; the
/// surroundings keep it away from the region.
struct SmoothedPart {
  Submesh part;
  Positions rest;    ///< in own numbers of the part
  Positions smooth;  ///< likewise
};

/// Fairs `region` and all vertices within `length` of it. With cotangent weights, their mean is
/// taken over this part. The cost is that of the part, besides clearing a few numbers per vertex of
/// the mesh. Throws what `Fairing::smooth` throws.
SmoothedPart smooth_part(const VertexSet& region, double length,
                         std::span<const Eigen::Vector3d> positions, const Topology& topology,
                         LaplacianWeights weights, const char* where);

/// Returns the region and every vertex within `distance` of it along the surface.
VertexSet grown(const VertexSet& region, double distance, const Topology& topology,
                std::span<const Eigen::Vector3d> positions);

/// Returns the whole mesh with the result of `smooth_part`. Throws what that throws.
Positions smooth_around(const VertexSet& region, double length,
                        std::span<const Eigen::Vector3d> positions, const Topology& topology,
                        LaplacianWeights weights, const char* where);

}  // namespace lapwing
