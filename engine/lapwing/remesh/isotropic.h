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
  /// Number of iterations. Each splits edges longer than 4/3 of the target length, collapses edges
  /// shorter than 4/5 (Botsch and Kobbelt 2004), flips edges, and relaxes the vertices.
  int iterations = 5;
  /// Edges whose triangles meet at more than this angle, in degrees, are features. They are split
  /// and collapsed, but not flipped, and their vertices move only along the feature line.
  double feature_angle_degrees = 45.0;
  bool operator==(const RemeshOptions&) const = default;
};

struct RemeshResult {
  Mesh mesh;
  /// Per vertex of the result: the vertex of the input if it is outside the patch or on its border,
  /// kNoIndex if it is new. Vertices of the input come first, in the same order.
  std::vector<Index> kept;
  VertexSet region;  ///< the vertices of the patch in the result, including its border
  std::string note;  ///< message to the user if remeshing was incomplete; usually empty
};

/// Returns the estimated number of triangles with edges of `length` that replace a triangle: the
/// equilateral triangles of the same area, plus some along its edges. If `length` is 0, returns
/// infinity, or 0 if the corners coincide.
double expected_triangles(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                          const Eigen::Vector3d& c, double length);

/// Local isotropic remeshing. Replaces the triangles of `mesh` whose three corners are in `region`
/// by nearly equilateral ones on the same surface, with edges of about `target_length(point)`.
/// Polygons of the patch are triangulated. The border of the patch and everything outside,
/// including attributes, are bitwise unchanged, and the mesh remains conforming. The boundary of an
/// open mesh also belongs to the border. Next to long border edges, triangles are gradually larger
/// than the target.
///
/// Inside the patch, texture coordinates (with their seams), colours and real attributes are
/// interpolated. Integers are copied from the nearest vertex, materials and groups from the nearest
/// face. Borders between materials, groups or UV charts are features, and edges at which stored
/// normals differ, unless these are most edges. A line with edges shorter than the target length
/// may move by about a tenth of that length. Deterministic.
///
/// Throws InputError, naming vertices, if the patch is not manifold or not finite; InputError if a
/// length is not positive or more than kMostTriangles would be necessary; SolverError if there is
/// not enough memory; and Cancelled.
RemeshResult remesh_isotropic(const Mesh& mesh, const VertexSet& region,
                              const std::function<double(const Eigen::Vector3d&)>& target_length,
                              const RemeshOptions& options = {}, const Progress& progress = {});

}  // namespace lapwing
