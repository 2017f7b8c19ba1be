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
  BoundaryLoop hole;              ///< their boundary, with them on its left
};

/// Host and part as one mesh, D in the paper: zipped, with the part as it was placed.
struct TransplantJoined {
  std::span<const Eigen::Vector3d> positions;
  const Topology& topology;
  /// The positions smoothed around the seam (`smooth_seam`). Areas, angles and maps are computed on
  /// these, since a strip between two loops may be folded.
  std::span<const Eigen::Vector3d> geometry;
  std::span<const Index> host_vertices;  ///< per vertex: its number in the host, or kNoIndex
  std::size_t host_faces = 0;            ///< faces below this number are the host's
  /// Per vertex that is not the host's: geodesic distance on the part from its loop; 0 between the
  /// loops.
  std::span<const double> depths;
  double gap = 0.0;  ///< mean distance between the loops
};

/// Options of `reconstruct_seam`. Extents are lengths.
struct TransplantOptions {
  /// The blend over the part, from its loop: 0 is the host, 1 the part.
  Transition transition;
  double padding = 0.0;  ///< free beyond the transition, and on the host's side of the seam
  double belt = 0.0;     ///< held beyond the padding, with weight 1
  LaplacianWeights weights = LaplacianWeights::cotangent;
  MappedSampling sampling = MappedSampling::one_ring;
};

/// The result of `reconstruct_seam`.
struct TransplantResult {
  Positions positions;  ///< of the whole joined mesh; unchanged bit for bit outside `region`
  VertexSet region;     ///< all unknowns
  VertexSet belt;       ///< of these, those that are held
  double relative_residual = 0.0;
  double last_change = 0.0;  ///< largest motion of a vertex in the last pass, in mean edge lengths
  bool sampled_host = true;  ///< false if hole or part is too small to have an inside to sample
  std::size_t flipped = 0;   ///< triangles that the two maps to the square turned over
};

/// Computes `joined.geometry` without reading it: fairs the positions (Fairing) of all free and
/// held vertices by twice the width of the free zone. Throws what `Fairing` throws.
Positions smooth_seam(const TransplantHost& host, const TransplantJoined& joined,
                      const TransplantOptions& options);

/// Reconstructs the surface around the seam of a transplant (paper section 6). Solves
///     (L'L + W) u = L' ((1 - w) (delta(D smooth) + T_U xi_U) + w T_S delta_S - delta(D))
/// for the displacement u of D, with one n x n factor. w is the transition's share, and delta_S are
/// the Laplacians of the part as it was placed. xi_U are the Laplacians of the host's offset from
/// its shape. They are sampled at the point of the host that corresponds to each vertex of D. A
/// host vertex corresponds to itself, a vertex of the transition to a point on the collar of the
/// removed region. Both collars are mapped to the unit square from the same seam, with their cuts
/// aligned. T_U and T_S = s R rotate with the shapes, from host and part to the result, whose shape
/// is updated in two more passes.
///
/// Shape is larger than twice the free zone's width, detail smaller than half of it. The host's
/// detail is transferred whole, as in coating. Features in between are as large as what was cut
/// out. With all of the host's Laplacians, as in the paper, an ear that was cut off bends the horn
/// that replaces it. So these are transferred only as far as host and joined mesh agree. A part
/// placed where it was cut from stays there. Throws InputError, naming `where`, if the transition
/// reaches another boundary or a handle, and SolverError if the system is singular. Stages
/// "collars", "laplacian", "sample", "solve".
TransplantResult reconstruct_seam(const TransplantHost& host, const TransplantJoined& joined,
                                  const TransplantOptions& options, Kernels& kernels,
                                  const std::string& where, StageTimings& timings,
                                  const Progress& progress = {});

}  // namespace lapwing
