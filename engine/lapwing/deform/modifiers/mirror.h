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

/// The plane is found from the shape (`find_mirror_plane`).
struct AutomaticMirror {
  bool operator==(const AutomaticMirror&) const = default;
};

/// A mirror as a person gave it.
struct MirrorSpec {
  std::variant<AutomaticMirror, MirrorPlane> plane;
  std::string where = "mirror";  ///< as in RegionSpec; no part of the value
  bool operator==(const MirrorSpec& other) const { return plane == other.plane; }
};

/// Throws InputError, naming `where`, for a plane that is none: numbers that are not finite, a
/// normal without length.
void require_plane(const MirrorPlane& plane, const std::string& where);

/// Throws InputError, naming `where`, for a plane that does not pass through the bounds of the
/// mesh, and what `require_plane` throws.
void require_through(const MirrorPlane& plane, const Mesh& mesh, const std::string& where);

/// x -> its mirror image.
Eigen::Affine3d reflection(const MirrorPlane& plane);

struct FoundMirror {
  MirrorPlane plane;
  /// The root mean square distance of the mirrored vertices from the surface, a share of the
  /// diagonal of its bounds: 0 for a symmetric shape.
  double asymmetry = 0.0;
};

/// The plane in which the surface is most nearly its own mirror image: from 26 planes through its
/// centroid on, by closest points (as ICP goes). About a second for any mesh, since at most 2,000
/// vertices are looked at. Throws InputError, naming
/// `where`, for a mesh without triangles of any extent.
FoundMirror find_mirror_plane(const Mesh& mesh, const std::string& where);

/// How far a mesh is from its image in `plane`, as above.
double asymmetry_of(const Mesh& mesh, const MirrorPlane& plane, const std::string& where);

/// For each vertex the one that lies where its mirror image is: the nearest corner of the nearest
/// point of the surface. On a symmetric mesh these are its pairs. Vertices without a triangle have
/// themselves. O(n log n). Throws what `require_through` throws.
std::vector<Index> mirror_images(const Mesh& mesh, const MirrorPlane& plane,
                                 const std::string& where);

/// The vertices whose image is in `set`.
VertexSet mirrored(const VertexSet& set, std::span<const Index> images);

}  // namespace lapwing
