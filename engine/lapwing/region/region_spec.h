#pragma once

#include <string>
#include <variant>
#include <vector>

#include "lapwing/mesh/mesh.h"
#include "lapwing/region/vertex_set.h"

namespace lapwing {

struct RegionSpec;

/// Every vertex of the mesh, loose ones too.
struct AllVertices {
  bool operator==(const AllVertices&) const = default;
};

/// The vertices named. An empty list is the one way to say "none".
struct ListedVertices {
  std::vector<Index> vertices;
  bool operator==(const ListedVertices&) const = default;
};

/// Vertices within the geodesic distance `radius` of a vertex, which is given by its number or as
/// the one nearest to a point (of those that have a ring).
struct GeodesicDisk {
  std::variant<Index, Eigen::Vector3d> center = Index{0};
  double radius = 0.0;
  bool operator==(const GeodesicDisk&) const = default;
};

/// Vertices in an axis-aligned box, its faces included.
struct Box {
  Eigen::Vector3d min = Eigen::Vector3d::Zero();
  Eigen::Vector3d max = Eigen::Vector3d::Zero();
  bool operator==(const Box&) const = default;
};

/// The vertices joined in order by shortest edge paths, the last to the first; and the side of that
/// closed loop that holds `inside`. The loop itself belongs to the region.
struct LoopRegion {
  std::vector<Index> loop;
  Index inside = 0;
  bool operator==(const LoopRegion&) const = default;
};

/// The vertices of any part.
struct UnionRegion {
  std::vector<RegionSpec> parts;
};

/// The vertices of the first part that are in none of the others.
struct DifferenceRegion {
  std::vector<RegionSpec> parts;
};

/// The largest disk inside a region (see largest_disk.h): what can be laid into the plane.
struct DiskInRegion {
  std::vector<RegionSpec> parts;  ///< one
};

bool operator==(const UnionRegion& a, const UnionRegion& b);
bool operator==(const DifferenceRegion& a, const DifferenceRegion& b);
bool operator==(const DiskInRegion& a, const DiskInRegion& b);

/// A choice of vertices as a person wrote it, not yet bound to a mesh.
struct RegionSpec {
  std::variant<AllVertices, ListedVertices, GeodesicDisk, Box, LoopRegion, UnionRegion,
               DifferenceRegion, DiskInRegion>
      form;
  /// Where it was written, as messages name it ("bend.json: /steps/0/roi"); no part of the value.
  std::string where = "region";

  bool operator==(const RegionSpec& other) const { return form == other.form; }
};

/// The vertices that `spec` chooses on `mesh`. Throws InputError, naming `where`: a vertex that the
/// mesh does not have, a box or difference that holds nothing, a disk near a mesh or in a region
/// without triangles, a loop that cannot be joined, does not separate the mesh or does not hold
/// `inside` on one side.
VertexSet resolve(const RegionSpec& spec, const Mesh& mesh);

}  // namespace lapwing
