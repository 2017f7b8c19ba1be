#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// Normals and their indices, as in MeshAttributes.
struct StoredNormals {
  std::vector<Eigen::Vector3d> normals;
  std::vector<Index> corner_normals;
};

/// Returns the stored normals after the vertices of the mesh moved from `rest` (per vertex; if
/// empty, all normals are recomputed). The corners of a vertex that share a normal get the
/// area-weighted mean of their faces' normals, so smooth vertices stay smooth and hard edges stay
/// hard. At a closed seam (JoinedSurface), joined vertices with equal normals share one. A normal
/// keeps its side, because a file may orient its faces clockwise. It stays bit for bit if its faces
/// turned by less than 1e-6 or have no area, or if no face uses it. Normals keep their indices. If
/// a normal was shared by vertices that now differ, the others get new ones at the end. O(n log n).
StoredNormals updated_normals(const Mesh& mesh, std::span<const Eigen::Vector3d> rest);

/// Computes normals for a mesh that has none: area-weighted means, split at hard edges
/// (SplitNormals). Every corner gets a normal, which is zero if all faces at its vertex have zero
/// area.
StoredNormals computed_normals(const Mesh& mesh, double feature_angle_degrees);

}  // namespace lapwing
