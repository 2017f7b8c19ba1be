#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "lapwing/base/progress.h"
#include "lapwing/base/stopwatch.h"
#include "lapwing/kernels/kernels.h"
#include "lapwing/laplacian/weights.h"
#include "lapwing/region/boundary_loops.h"
#include "lapwing/region/transition.h"

namespace lapwing {

/// The host before anything is cut from it, U in the paper.
struct TransplantHost {
  std::span<const Eigen::Vector3d> positions;
  const Topology& topology;
  std::span<const Triangle> cut;  ///< the triangles that go
  BoundaryLoop hole;              ///< their boundary, with them on its left
};

/// Host and part as one mesh, D in the paper: zipped, the part where it was placed.
struct TransplantJoined {
  std::span<const Eigen::Vector3d> positions;
  const Topology& topology;
  /// The same, smooth around the seam: what areas, angles and maps are taken from, since a strip
  /// between two loops may be folded. See `smooth_seam`.
  std::span<const Eigen::Vector3d> geometry;
  std::span<const Index> host_vertices;  ///< per vertex: its number in the host, or kNoIndex
  std::size_t host_faces = 0;            ///< faces below this number are the host's
  /// Per vertex that is none of the host's: geodesic distance from the part's loop on the part; 0
  /// between the loops.
  std::span<const double> depths;
  double gap = 0.0;  ///< mean distance between the loops
};

/// How far from the seam what happens. Lengths.
struct TransplantOptions {
  /// Over the part, from its loop: 0 is all as on the host, 1 all as on the part.
  Transition transition;
  double padding = 0.0;  ///< vertices beyond it, and on the host's side, that are free too
  double belt = 0.0;     ///< beyond those: held by weight 1
  LaplacianWeights weights = LaplacianWeights::cotangent;
  MappedSampling sampling = MappedSampling::one_ring;
};

/// What the reconstruction came to.
struct TransplantResult {
  Positions positions;  ///< of the whole joined mesh; bit for bit as before outside `region`
  VertexSet region;     ///< all unknowns
  VertexSet belt;       ///< of these, those that are held
  double relative_residual = 0.0;
  double last_change = 0.0;  ///< the farthest that a vertex went in the last pass, in mean edges
  bool sampled_host = true;  ///< false where the hole is too small to have an inside to sample
  std::size_t flipped = 0;   ///< triangles that the two maps over the square turned over
};

/// `joined.geometry` for `joined`, of which that is not read: the positions faired (see Fairing)
/// over all that is free or held, by a length of twice what is free. Throws what `Fairing` does.
Positions smooth_seam(const TransplantHost& host, const TransplantJoined& joined,
                      const TransplantOptions& options);

/// Reconstructs what lies around the seam of a transplant (paper section 6). With u the
/// displacement of D, D smooth its shape, xi_U the Laplacians of what the host has over its own
/// shape, where D comes to lie on it - its vertices on the host's side on themselves, the
/// transition on the collar of what was cut, both laid over the unit square from the same seam with
/// their cuts aligned - delta_S those of the part as it was placed, w the transition's share,
///     (L'L + W) u = L' ((1 - w) (delta(D smooth) + T_U xi_U) + w T_S delta_S - delta(D))
/// on one n x n factor. Shape is what is larger than twice what is free; detail, what is smaller
/// than half of that, comes over from the host whole, as in coating. What is between is as large as
/// what was cut out: the paper blends it in with all of the host's Laplacians, and then the ear
/// that was there bends the horn that comes. So of this only as much comes over as host and joined
/// mesh agree on. T_U and T_S = s R turn with the shapes, from host and part to what comes out,
/// whose shape is taken anew in two more passes. A part that is where it was cut from stays there.
/// Throws InputError, naming `where`, when the transition reaches another boundary or a handle, and
/// SolverError when the system is singular. Stages "collars", "laplacian", "sample", "solve".
TransplantResult reconstruct_seam(const TransplantHost& host, const TransplantJoined& joined,
                                  const TransplantOptions& options, Kernels& kernels,
                                  const std::string& where, StageTimings& timings,
                                  const Progress& progress = {});

}  // namespace lapwing
