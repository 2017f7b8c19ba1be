#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "lapwing/base/progress.h"
#include "lapwing/mesh/mesh.h"
#include "lapwing/region/vertex_set.h"

namespace lapwing {

struct RemeshOptions {
  /// Rounds. In each, edges longer than 4/3 of the target are split, shorter than 4/5 collapsed
  /// (Botsch and Kobbelt 2004), others flipped, and vertices spread out.
  int iterations = 5;
  /// Edges whose triangles meet at more than this angle, in degrees, are features: they are cut to
  /// length, but neither flipped nor left by their vertices.
  double feature_angle_degrees = 45.0;
  bool operator==(const RemeshOptions&) const = default;
};

struct RemeshResult {
  Mesh mesh;
  /// Per vertex of the result: its number in the input where it is a vertex outside the patch or on
  /// its border, kNoIndex where it was made. Those that are kept come first, in their order.
  std::vector<Index> kept;
  VertexSet region;  ///< the patch's vertices in the result, border included
  std::string note;  ///< what could not be done, for a person; empty mostly
};

/// About how many triangles with edges of `length` remeshing makes of one with these corners:
/// equilateral ones that would fill it, and along the sides of a thin one. With edges of length 0,
/// infinitely many; 0 of one point.
double expected_triangles(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                          const Eigen::Vector3d& c, double length);

/// Local isotropic remeshing: the triangles of `mesh` whose three corners are in `region` are
/// replaced by nearly equilateral ones with edges of about `target_length(point)`, on the same
/// surface; polygons of the patch are triangulated. Everything outside and the border of the patch
/// stay as they are, bit for bit, and conforming; so do vertex and face attributes there. The
/// boundary of an open mesh is border too. Next to border edges longer than the target, triangles
/// grow towards their size. Inside, texture coordinates (seams kept), colours and numeric
/// attributes are interpolated (whole numbers taken from the nearest vertex), materials and groups
/// taken from the nearest face. Lines between different materials, groups or UV charts are
/// features; so are edges where stored normals differ, unless most do. A line whose own edges are
/// shorter than the target may be straightened, by about a tenth of it at most. Deterministic.
/// Throws InputError, naming vertices, when the patch is not manifold or not finite or the length
/// is not positive, or so small that it would make more than kMostTriangles; SolverError when there
/// is not the memory for them; Cancelled when `progress` says so.
RemeshResult remesh_isotropic(const Mesh& mesh, const VertexSet& region,
                              const std::function<double(const Eigen::Vector3d&)>& target_length,
                              const RemeshOptions& options = {}, const Progress& progress = {});

}  // namespace lapwing
