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
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();  ///< any length except 0
  bool operator==(const MirrorPlane&) const = default;
};

/// Finds the plane from the shape (`find_mirror_plane`).
struct AutomaticMirror {
  bool operator==(const AutomaticMirror&) const = default;
};

/// A mirror plane as the user specified it.
struct MirrorSpec {
  std::variant<AutomaticMirror, MirrorPlane> plane = {};
  std::string where = "mirror";  ///< as in RegionSpec; ignored by ==
  bool operator==(const MirrorSpec& other) const { return plane == other.plane; }
};

/// Throws InputError if a number is not finite or the normal is 0. The message begins with `where`.
void require_plane(const MirrorPlane& plane, const std::string& where);

/// Throws InputError if the plane does not intersect the bounding box of the mesh. The message
/// begins with `where`. Also throws the errors of `require_plane`.
void require_through(const MirrorPlane& plane, const Mesh& mesh, const std::string& where);

/// Returns the map of points to their mirror images.
Eigen::Affine3d reflection(const MirrorPlane& plane);

struct FoundMirror {
  MirrorPlane plane;
  /// Root mean square distance of the mirrored vertices from the surface, divided by the diagonal
  /// of its bounding box; 0 for a symmetric shape.
  double asymmetry = 0.0;
};

/// Finds the plane in which the surface is most symmetric, by iterative closest points (ICP)
/// starting from 26 planes through the centroid. Takes about a second for any mesh, because it uses
/// at most 2,000 vertices. Throws InputError if the mesh has no triangles or all their vertices
/// coincide. The message begins with `where`.
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
