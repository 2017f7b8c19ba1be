#pragma once

#include <span>
#include <string>
#include <variant>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/mesh/mesh.h"
#include "lapwing/region/vertex_set.h"

namespace lapwing {

struct MirrorPlane {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();  ///< not 0; of any length
  bool operator==(const MirrorPlane&) const = default;
};

/// Finds the plane from the shape (`find_mirror_plane`).
struct AutomaticMirror {
  bool operator==(const AutomaticMirror&) const = default;
};

/// A mirror as the user wrote it.
struct MirrorSpec {
  std::variant<AutomaticMirror, MirrorPlane> plane = {};
  std::string where = "mirror";  ///< as in RegionSpec; ignored by ==
  bool operator==(const MirrorSpec& other) const { return plane == other.plane; }
};

/// Throws InputError, naming `where`, if a number is not finite or the normal is 0.
void require_plane(const MirrorPlane& plane, const std::string& where);

/// Throws InputError, naming `where`, for a plane that does not pass through the bounds of the
/// mesh, and what `require_plane` throws.
void require_through(const MirrorPlane& plane, const Mesh& mesh, const std::string& where);

/// Returns the map of points to their mirror images.
Eigen::Affine3d reflection(const MirrorPlane& plane);

struct FoundMirror {
  MirrorPlane plane;
  /// Root mean square distance of the mirrored vertices from the surface, over the diagonal of its
  /// bounds; 0 for a symmetric shape.
  double asymmetry = 0.0;
};

/// Finds the plane in which the surface is most symmetric, by iterated closest points (ICP) from 26
/// planes through its centroid. Takes about a second for any mesh, since it uses at most 2,000
/// vertices. Throws InputError, naming `where`, if no triangle of the mesh has any extent.
FoundMirror find_mirror_plane(const Mesh& mesh, const std::string& where);

/// Returns FoundMirror::asymmetry of a mesh for `plane`.
double asymmetry_of(const Mesh& mesh, const MirrorPlane& plane, const std::string& where);

/// Returns, for each vertex, the vertex that serves as its mirror image. This is the nearest corner
/// of the triangle that is closest to the mirrored position. A vertex without a triangle is its own
/// image. Takes O(n log n). Throws the errors of `require_through`.
std::vector<Index> mirror_images(const Mesh& mesh, const MirrorPlane& plane,
                                 const std::string& where);

/// Returns the vertices whose image is in `set`.
VertexSet mirrored(const VertexSet& set, std::span<const Index> images);

}  // namespace lapwing
