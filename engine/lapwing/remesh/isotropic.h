#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "lapwing/base/cancellation.h"
#include "lapwing/mesh/mesh.h"
#include "lapwing/region/vertex_set.h"

namespace lapwing {

struct RemeshOptions {
  /// Number of rounds. Each splits edges longer than 4/3 of the target, collapses those shorter
  /// than 4/5 (Botsch and Kobbelt 2004), flips others, and spreads out the vertices.
  int iterations = 5;
  /// Edges whose triangles meet at more than this angle, in degrees, are features. They are cut to
  /// length but not flipped, and their vertices stay on them.
  double feature_angle_degrees = 45.0;
  bool operator==(const RemeshOptions&) const = default;
};

struct RemeshResult {
  Mesh mesh;
  /// Per vertex of the result: its number in the input if it is outside the patch or on its border,
  /// kNoIndex if it is new. Kept vertices come first, in the old order.
  std::vector<Index> kept;
  VertexSet region;  ///< the patch's vertices in the result, border included
  std::string note;  ///< message about what could not be done; usually empty
};

/// Estimates how many triangles with edges of `length` remeshing makes of a triangle: the
/// equilateral ones that would fill it, plus those along its sides. If `length` is 0, returns
/// infinity, or 0 if the corners coincide.
double expected_triangles(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                          const Eigen::Vector3d& c, double length);

/// Local isotropic remeshing. Replaces the triangles of `mesh` whose three corners are in `region`
/// by nearly equilateral ones on the same surface, with edges of about `target_length(point)`.
/// Polygons of the patch are triangulated. Everything outside and the border of the patch stay the
/// same bit for bit, including attributes, and conforming. The boundary of an open mesh is border
/// too. Next to border edges longer than the target, triangles grow towards their size.
///
/// Inside, texture coordinates (seams kept), colours and numeric attributes are interpolated. Whole
/// numbers come from the nearest vertex, materials and groups from the nearest face. Lines between
/// materials, groups or UV charts are features, and so are edges at which stored normals differ,
/// unless most do. A line with edges shorter than the target may be straightened, by about a tenth
/// of it at most. Deterministic.
///
/// Throws InputError, naming vertices, if the patch is not manifold or not finite; InputError if
/// the length is not positive or would make more than kMostTriangles; SolverError if there is not
/// enough memory; Cancelled if `progress` says so.
RemeshResult remesh_isotropic(const Mesh& mesh, const VertexSet& region,
                              const std::function<double(const Eigen::Vector3d&)>& target_length,
                              const RemeshOptions& options = {}, const Progress& progress = {});

}  // namespace lapwing
