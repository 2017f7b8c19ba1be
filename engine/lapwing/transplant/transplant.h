#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "lapwing/base/progress.h"
#include "lapwing/base/stopwatch.h"
#include "lapwing/kernels/kernels.h"
#include "lapwing/mesh/mesh.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/region/vertex_set.h"
#include "lapwing/transplant/transplant_request.h"

namespace lapwing {

/// What a transplant did. Lengths are on the mesh that the part was put on.
struct TransplantReport {
  std::size_t part_vertices = 0;
  std::size_t host_loop = 0;  ///< vertices
  std::size_t part_loop = 0;
  std::size_t welded = 0;  ///< pairs of them that became one
  std::size_t strip_triangles = 0;
  std::size_t remeshed_vertices = 0;  ///< of the transition afterwards; 0 where it was even enough
  bool turned = false;                ///< the part was inside out
  Eigen::Matrix<double, 3, 4> place =
      Eigen::Matrix<double, 3, 4>::Zero();  ///< from where it was given
  double transition_width = 0.0;
  double padding = 0.0;
  double belt = 0.0;
  std::size_t flipped = 0;  ///< triangles that the maps over the square turned over
  double relative_residual = 0.0;
  double last_change = 0.0;  ///< of the last pass, in mean edge lengths
  /// By how much the surface turns over the edges at the hole's rim: all but a hundredth by less.
  double seam_degrees = 0.0;
  double largest_displacement = 0.0;  ///< from where the part was placed
  Index largest_displacement_vertex = kNoIndex;
};

/// What `transplant` makes of two meshes.
struct Transplanted {
  Mesh mesh;  ///< the joined one: the host's vertices and faces first, in their order
  TransplantReport report;
  std::vector<std::string> warnings;  ///< for a person, in the order of the work
  VertexSet region;                   ///< around the seam, what was reconstructed
  VertexSet belt;                     ///< of that, what stays
  std::vector<Index> host_vertices;   ///< per vertex: its number in the host, or kNoIndex
  Positions placed;                   ///< per vertex, before the reconstruction
  StageTimings timings;
};

/// `part`, or what `request` cuts from it, in the place of a region of `host` (paper, section 6).
/// The part may be `host` itself. The processor computes it. Throws InputError, naming the region
/// or the part, for what does not fit, and SolverError.
Transplanted transplant(const Mesh& host, const Mesh& part, const TransplantRequest& request);

/// The same on any device; `topology` is that of `host`, and `part_name` names the group of the
/// part's faces. Stages "part", "zip", "smooth", "remesh", and those of `reconstruct_seam`.
Transplanted transplant(const Mesh& host, const Mesh& part, const std::string& part_name,
                        const TransplantRequest& request, Kernels& kernels,
                        const Progress& progress = {});

}  // namespace lapwing
