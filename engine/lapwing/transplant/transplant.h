#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/stopwatch.h"
#include "lapwing/kernels/kernels.h"
#include "lapwing/mesh/mesh.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/region/vertex_set.h"
#include "lapwing/transplant/transplant_request.h"

namespace lapwing {

/// What a transplant did. Lengths are those of the host.
struct TransplantReport {
  std::size_t part_vertices = 0;
  std::size_t host_loop = 0;  ///< vertices
  std::size_t part_loop = 0;
  std::size_t welded = 0;  ///< pairs of loop vertices merged into one
  std::size_t strip_triangles = 0;
  std::size_t remeshed_vertices = 0;  ///< in the transition after remeshing; 0 if it was even
                                      ///< enough
  bool turned = false;                ///< the part was inside out
  Eigen::Matrix<double, 3, 4> place =
      Eigen::Matrix<double, 3, 4>::Zero();  ///< motion from its original place
  double transition_width = 0.0;
  double padding = 0.0;
  double belt = 0.0;
  std::size_t flipped = 0;  ///< triangles that the maps to the square turned over
  double relative_residual = 0.0;
  double last_change = 0.0;  ///< largest motion in the last pass, in mean edge lengths
  /// 99th percentile of the angles between the normals at edges on the hole's rim.
  double seam_degrees = 0.0;
  double largest_displacement = 0.0;  ///< by the reconstruction
  Index largest_displacement_vertex = kNoIndex;
};

/// The result of `transplant`.
struct Transplanted {
  Mesh mesh;  ///< the joined one: the host's vertices and faces first, in their order
  TransplantReport report;
  std::vector<std::string> warnings;  ///< messages to the user, in the order of the work
  VertexSet region;                   ///< the reconstructed vertices around the seam
  VertexSet belt;                     ///< those of them that are held
  std::vector<Index> host_vertices;   ///< per vertex: its number in the host, or kNoIndex
  Positions placed;                   ///< per vertex, before the reconstruction
  StageTimings timings;
};

/// Puts `part`, or the piece of it that `request` selects, in the place of a region of `host`
/// (paper, section 6). The part may be `host` itself. Runs on the CPU. Throws InputError, naming
/// the region or the part, if the request does not fit the meshes, and SolverError.
Transplanted transplant(const Mesh& host, const Mesh& part, const TransplantRequest& request);

/// The same on any device. `part_name` names the group of the part's faces. Stages "part", "zip",
/// "smooth", "remesh", and those of `reconstruct_seam`.
Transplanted transplant(const Mesh& host, const Mesh& part, const std::string& part_name,
                        const TransplantRequest& request, Kernels& kernels,
                        const Progress& progress = {});

}  // namespace lapwing
