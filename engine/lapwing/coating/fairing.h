#pragma once

#include <memory>
#include <span>
#include <vector>

#include "lapwing/laplacian/rsi_system.h"
#include "lapwing/laplacian/system_pattern.h"
#include "lapwing/laplacian/weights.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/region/submesh.h"
#include "lapwing/solve/block_solver.h"

namespace lapwing {

/// Implicit fairing (Desbrun et al. 1999) of a region, its amount given as a length: the smooth
/// surface x is the minimum of
///     sum_i m_i |x_i - v_i|^2 + t^2 sum_i m_i |(D x)_i|^2,   t = (length / 2 pi)^2,
/// with D the Laplace operator of the surface and m_i the area around vertex i, that is one
/// implicit step of the bi-Laplacian, (I + t^2 D^2) x = v. A wave of length w keeps 1 / (1 +
/// (length/w)^4) of its height: a half at w = length, 6% at half of it, 94% at twice. The border is
/// held: vertices of the region with a neighbour outside it or on the mesh's boundary do not move.
///
/// Both schemes of weights measure in lengths: (D x)_i = sum_j s_ij (x_i - x_j) / m_i with
/// m_i = sum_j s_ij |e_ij|^2 / 4, which is right for |x|^2 on any ring. With cotangents for s_ij
/// that is the cotangent operator over Voronoi areas, with s_ij = 1 the umbrella over the ring's
/// extent.
class Fairing {
 public:
  /// Analyzes; linear time but for the ordering. `positions` and `topology` must outlive the
  /// object.
  Fairing(std::span<const Eigen::Vector3d> positions, const Topology& topology,
          const VertexSet& region, LaplacianWeights weights);

  /// The positions of the whole mesh with the region smooth. Factors an n x n system. Throws
  /// InputError when `length` is not above 0, naming `where`.
  Positions smooth(double length, const char* where = "detail_size") const {
    return smooth(positions_, length, where);
  }
  /// The same of other positions of the same mesh, by the areas and angles of those given first:
  /// where those have none worth having.
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

/// Fairing of a region and what lies within a length of it, on a mesh of the two alone: fairing's
/// border is held where the mesh goes on, so that it leaves the region itself alone.
struct SmoothedPart {
  Submesh part;
  Positions rest;    ///< own numbers of the part
  Positions smooth;  ///< likewise
};

/// `region` smooth, with what lies within `length` of it. Where edges are weighted by cotangents,
/// their mean is that of the part. Beside clearing a few numbers per vertex of the mesh, the cost
/// is that of the part. Throws as `Fairing::smooth` does.
SmoothedPart smooth_part(const VertexSet& region, double length,
                         std::span<const Eigen::Vector3d> positions, const Topology& topology,
                         LaplacianWeights weights, const char* where);

/// The region and every vertex within `distance` of it, along the surface.
VertexSet grown(const VertexSet& region, double distance, const Topology& topology,
                std::span<const Eigen::Vector3d> positions);

/// The whole mesh with what `smooth_part` gives. Throws as that does.
Positions smooth_around(const VertexSet& region, double length,
                        std::span<const Eigen::Vector3d> positions, const Topology& topology,
                        LaplacianWeights weights, const char* where);

}  // namespace lapwing
