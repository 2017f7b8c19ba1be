#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/stopwatch.h"
#include "lapwing/kernels/kernels.h"
#include "lapwing/laplacian/weights.h"
#include "lapwing/region/boundary_loops.h"
#include "lapwing/region/transition.h"
#include "lapwing/region/vertex_set.h"

namespace lapwing {

/// The host before the cut, U in the paper.
struct TransplantHost {
  std::span<const Eigen::Vector3d> positions;
  const Topology& topology;
  std::span<const Triangle> cut;  ///< the triangles to remove
  BoundaryLoop hole;              ///< boundary of `cut`, with these triangles on its left
};

/// The mesh of host, strip and placed part before the reconstruction, D in the paper.
struct TransplantJoined {
  std::span<const Eigen::Vector3d> positions;
  const Topology& topology;
  /// The positions smoothed around the seam (`smooth_seam`). Areas, angles and maps are computed
  /// from these positions, because the strip may be folded.
  std::span<const Eigen::Vector3d> geometry;
  std::span<const Index> host_vertices;  ///< per vertex: the vertex of the host, or kNoIndex
  std::size_t host_faces = 0;            ///< number of faces of the host, which come first
  /// Per vertex that is not in the host: geodesic distance on the part from its loop; 0 in the
  /// strip.
  std::span<const double> depths;
  double gap = 0.0;  ///< mean distance between the loops
};

/// Options of `reconstruct_seam`. `padding` and `belt` are lengths.
struct TransplantOptions {
  /// Weight of the part, as a function of the distance from its loop: 0 is the host, 1 the part.
  Transition transition;
  /// Width of the free zone beyond the transition, and of the free zone of the host.
  double padding = 0.0;
  double belt = 0.0;  ///< width of the belt beyond the padding, held with weight 1
  LaplacianWeights weights = LaplacianWeights::cotangent;
  MappedSampling sampling = MappedSampling::one_ring;
};

/// The result of `reconstruct_seam`.
struct TransplantResult {
  Positions positions;  ///< positions of the joined mesh; bitwise unchanged outside `region`
  VertexSet region;     ///< all unknowns
  VertexSet belt;       ///< the vertices of `region` that are held
  double relative_residual = 0.0;
  /// Largest displacement of a vertex in the last pass, in mean edge lengths.
  double last_change = 0.0;
  bool sampled_host = true;  ///< false if hole or part is too small for a collar
  std::size_t flipped = 0;   ///< number of triangles that the two maps to the square flipped
};

/// Computes `joined.geometry`, which it does not read: fairs all free and held vertices, with twice
/// the width of the free zone as length. Throws the errors of `Fairing`.
Positions smooth_seam(const TransplantHost& host, const TransplantJoined& joined,
                      const TransplantOptions& options);

/// Reconstructs the surface around the seam of a transplant (paper section 6). Solves
///     (L'L + W) u = L' ((1 - w) (delta(D smooth) + T_U xi_U) + w T_S delta_S - delta(D))
/// for the displacement u of D, with one factor of an n x n matrix. w is the value of the
/// transition, delta_S are the Laplacians of the placed part, and xi_U those of the host's detail.
/// xi_U is sampled at the host point of each vertex of D: a host vertex itself, or for a vertex of
/// the transition, a point on the collar of the removed region. Both collars have the same seam and
/// are mapped to the unit square with aligned cuts. T_U and T_S = s R map the frames of host and
/// part to those of the result, whose smooth shape is updated in two more passes.
///
/// Features larger than twice the width of the free zone are shape; features smaller than half of
/// it are detail. The host's detail is transferred completely, as in coating. Features between both
/// sizes are about as large as the removed region. If they were transferred completely, as in the
/// paper, a removed ear would bend the horn that replaces it, so they are multiplied by the
/// correlation of host and joined mesh. A part at its original position does not move. Throws
/// InputError, naming `where`, if the transition reaches another boundary or a topological handle,
/// and SolverError if the system is singular. Stages "collars", "laplacian", "sample", "solve".
TransplantResult reconstruct_seam(const TransplantHost& host, const TransplantJoined& joined,
                                  const TransplantOptions& options, Kernels& kernels,
                                  const std::string& where, StageTimings& timings,
                                  const Progress& progress = {});

}  // namespace lapwing
