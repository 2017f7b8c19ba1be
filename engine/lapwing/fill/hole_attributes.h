#pragma once

#include <span>
#include <vector>

#include "lapwing/doctor/holes.h"
#include "lapwing/mesh/mesh.h"
#include "lapwing/mesh/topology.h"

namespace lapwing {

/// Triangles that fill a hole. The first `points` are the rim's; the others are new vertices.
struct HolePatch {
  Positions points;
  std::vector<Triangle> triangles;  ///< indices into `points`
};

/// Returns weights of the points of `rim`, which sum to 1 and fall with the squared distance from
/// `point`. A rim point at `point` has all the weight.
std::vector<double> rim_weights(std::span<const Eigen::Vector3d> rim, const Eigen::Vector3d& point);

/// Returns the mesh vertex of each point: first the vertices of the rim, then `first_new`,
/// `first_new` + 1, ...
std::vector<Index> patch_vertices(const Hole& hole, const HolePatch& patch, Index first_new);

/// Appends the new vertices and the triangles of all patches, one per hole, to `mesh`, with
/// attributes. New vertices blend the colours of the rim and copy other properties from its nearest
/// vertex. Triangles copy material, group, colour and properties from a face at the nearest rim
/// vertex. They get normals if the mesh has normals, but no texture coordinates. Resets
/// `mesh.source`.
void append_patches(Mesh& mesh, std::span<const Hole> holes, std::span<const HolePatch> patches);

}  // namespace lapwing
