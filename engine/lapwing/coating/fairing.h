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

/// Implicit fairing (Desbrun et al. 1999) of a region. A length defines the amount of smoothing.
/// The smooth surface x minimizes
///     sum_i m_i |x_i - v_i|^2 + t^2 sum_i m_i |(D x)_i|^2,   t = (length / 2 pi)^2,
/// where v are the given positions, D is the Laplace operator of the surface and m_i the area of
/// vertex i. This is one implicit step of the bi-Laplacian flow, (I + t^2 D^2) x = v. The amplitude
/// of a wave of length w is multiplied by 1 / (1 + (length/w)^4): 1/2 for w = length, 6 % for half
/// and 94 % for twice this length. Vertices of the region with a neighbour outside it or on the
/// mesh's boundary do not move.
///
/// (D x)_i = sum_j s_ij (x_i - x_j) / m_i with m_i = sum_j s_ij |e_ij|^2 / 4, which is exact for
/// |x|^2 on any ring. If s_ij are cotangents, this is the cotangent operator with Voronoi areas. If
/// s_ij = 1, it is the umbrella operator scaled by the size of the ring.
class Fairing {
 public:
  /// Analyzes the system in linear time, except for the fill-reducing ordering. `positions` and
  /// `topology` must outlive the object.
  Fairing(std::span<const Eigen::Vector3d> positions, const Topology& topology,
          const VertexSet& region, LaplacianWeights weights);

  /// Returns the positions of the whole mesh with a smooth region. Factorizes an n x n system.
  /// Throws InputError, naming `where`, unless `length` is positive.
  Positions smooth(double length, const char* where = "detail_size") const {
    return smooth(positions_, length, where);
  }
  /// Smooths other positions of the mesh, with the areas and angles of the constructor's positions.
  /// For positions with degenerate areas and angles.
  Positions smooth(std::span<const Eigen::Vector3d> other, double length,
                   const char* where = "detail_size") const;

  /// Returns the vertices that move.
  const VertexSet& free() const { return unknowns_.vertices; }

 private:
  std::span<const Eigen::Vector3d> positions_;
  Unknowns unknowns_;
  std::vector<double> masses_;  ///< per unknown
  BlockRows rows_;              ///< D, each row times the square root of its mass
  std::unique_ptr<SystemPattern> pattern_;
  std::unique_ptr<BlockSolver> solver_;  ///< analyzed
};

/// A faired region and its surroundings, as a separate mesh. The surroundings separate the region
/// from the fixed border.
struct SmoothedPart {
  Submesh part;
  Positions rest;    ///< by local index of `part`
  Positions smooth;  ///< by local index of `part`
};

/// Fairs `region` and all vertices within `length` of it. Cotangent weights are clamped and scaled
/// by their mean in this part. The cost is that of the part, except that a few numbers per vertex
/// of the mesh are cleared. Throws the errors of `Fairing::smooth`.
SmoothedPart smooth_part(const VertexSet& region, double length,
                         std::span<const Eigen::Vector3d> positions, const Topology& topology,
                         LaplacianWeights weights, const char* where);

/// Returns the region and all vertices within the geodesic distance `distance` of it.
VertexSet grown(const VertexSet& region, double distance, const Topology& topology,
                std::span<const Eigen::Vector3d> positions);

/// Returns the whole mesh with the result of `smooth_part`, and throws its errors.
Positions smooth_around(const VertexSet& region, double length,
                        std::span<const Eigen::Vector3d> positions, const Topology& topology,
                        LaplacianWeights weights, const char* where);

}  // namespace lapwing
