#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// The normals of a mesh's attributes, as MeshAttributes has them.
struct StoredNormals {
  std::vector<Eigen::Vector3d> normals;
  std::vector<Index> corner_normals;
};

/// The stored normals after the mesh's vertices moved from `rest` (per vertex; empty when unknown,
/// which recomputes all). All corners of a vertex that share a normal get the area-weighted mean of
/// their faces' normals, so smooth vertices stay smooth and hard edges stay hard; across a seam
/// (JoinedSurface) that is closed, vertices share a normal where theirs were equal. On the side
/// where the old one lay (a file may mean its faces clockwise). A normal stays as it is, bit for
/// bit, where the faces turned by less than 1e-6, have no area, or no face uses it. Normals keep
/// their numbers; where one was shared by vertices that now differ, the others get new ones at the
/// end. O(n log n).
StoredNormals updated_normals(const Mesh& mesh, std::span<const Eigen::Vector3d> rest);

}  // namespace lapwing
