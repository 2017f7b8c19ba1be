#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/stopwatch.h"
#include "lapwing/base/warning.h"
#include "lapwing/kernels/kernels.h"
#include "lapwing/mesh/mesh.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/region/vertex_set.h"
#include "lapwing/transplant/transplant_request.h"

namespace lapwing {

/// Report of a transplant. Lengths are in units of the host.
struct TransplantReport {
  std::size_t part_vertices = 0;
  std::size_t host_loop = 0;  ///< number of vertices of the hole's loop
  std::size_t part_loop = 0;
  std::size_t welded = 0;  ///< number of merged pairs of loop vertices
  std::size_t strip_triangles = 0;
  /// Vertices of the remeshed transition; 0 if it was not remeshed.
  std::size_t remeshed_vertices = 0;
  bool turned = false;  ///< whether the part was inside out
  Eigen::Matrix<double, 3, 4> place =
      Eigen::Matrix<double, 3, 4>::Zero();  ///< motion from the original position
  double transition_width = 0.0;
  double padding = 0.0;
  double belt = 0.0;
  std::size_t flipped = 0;  ///< number of triangles that the maps to the square flipped
  double relative_residual = 0.0;
  double last_change = 0.0;  ///< largest displacement in the last pass, in mean edge lengths
  /// 99th percentile of the angles between the face normals at edges with an end on the hole's rim.
  double seam_degrees = 0.0;
  double largest_displacement = 0.0;  ///< by the reconstruction
  Index largest_displacement_vertex = kNoIndex;
  std::vector<Warning> warnings;  ///< messages to the user, in the order of the stages
};

/// The result of `transplant`.
struct Transplanted {
  Mesh mesh;  ///< the joined mesh; the host's vertices and faces come first, in their order
  TransplantReport report;
  VertexSet region;                   ///< the reconstructed vertices around the seam
  VertexSet belt;                     ///< the held vertices of `region`
  std::vector<Index> host_vertices;   ///< per vertex: the vertex of the host, or kNoIndex
  Positions placed;                   ///< positions before the reconstruction
  StageTimings timings;
};

/// Replaces a region of `host` by `part` or by the piece of it that `request` selects (paper,
/// section 6). `part` may be `host` itself. Runs on the CPU. Throws SolverError, and InputError,
/// naming the region or the part, if the request does not fit the meshes.
Transplanted transplant(const Mesh& host, const Mesh& part, const TransplantRequest& request);

/// Runs a transplant on any device. `part_name` is the group name of the part's faces. Stages
/// "part", "zip", "smooth", "remesh", and those of `reconstruct_seam`.
Transplanted transplant(const Mesh& host, const Mesh& part, const std::string& part_name,
                        const TransplantRequest& request, Kernels& kernels,
                        const Progress& progress = {});

}  // namespace lapwing
