#pragma once

#include <string>
#include <variant>
#include <vector>

#include "lapwing/mesh/mesh.h"
#include "lapwing/region/vertex_set.h"

namespace lapwing {

struct RegionSpec;

/// All vertices of the mesh, including loose ones.
struct AllVertices {
  bool operator==(const AllVertices&) const = default;
};

/// The listed vertices. Only an empty list selects no vertices.
struct ListedVertices {
  std::vector<Index> vertices;
  bool operator==(const ListedVertices&) const = default;
};

/// Vertices within the geodesic distance `radius` of a vertex. A position selects the nearest
/// vertex with a nonempty ring.
struct GeodesicDisk {
  std::variant<Index, Eigen::Vector3d> center = Index{0};
  double radius = 0.0;
  bool operator==(const GeodesicDisk&) const = default;
};

/// Vertices in an axis-aligned box, including its faces.
struct Box {
  Eigen::Vector3d min = Eigen::Vector3d::Zero();
  Eigen::Vector3d max = Eigen::Vector3d::Zero();
  bool operator==(const Box&) const = default;
};

/// The side of a closed loop that contains `inside`, and the loop itself. Shortest edge paths
/// connect the vertices of `loop` in order, and the last to the first.
struct LoopRegion {
  std::vector<Index> loop;
  Index inside = 0;
  bool operator==(const LoopRegion&) const = default;
};

/// The union of the parts.
struct UnionRegion {
  std::vector<RegionSpec> parts;
};

/// The vertices of the first part that are in no other part.
struct DifferenceRegion {
  std::vector<RegionSpec> parts;
};

/// The largest disk inside a region (see largest_disk.h), which can be flattened.
struct DiskInRegion {
  std::vector<RegionSpec> parts;  ///< exactly one
};

bool operator==(const UnionRegion& a, const UnionRegion& b);
bool operator==(const DifferenceRegion& a, const DifferenceRegion& b);
bool operator==(const DiskInRegion& a, const DiskInRegion& b);

/// A selection of vertices as the user defined it, not yet resolved on a mesh.
struct RegionSpec {
  std::variant<AllVertices, ListedVertices, GeodesicDisk, Box, LoopRegion, UnionRegion,
               DifferenceRegion, DiskInRegion>
      form;
  /// Location in the input, for messages ("bend.json: /steps/0/roi"); ignored by ==.
  std::string where = "region";

  bool operator==(const RegionSpec& other) const { return form == other.form; }
};

/// Returns the vertices that `spec` selects on `mesh`. Throws InputError, naming `where`, if the
/// mesh has no triangles, a vertex index is out of range, a box or difference is empty, a disk is
/// requested in a region without triangles, or a loop cannot be closed, does not separate the mesh
/// or passes through `inside`.
VertexSet resolve(const RegionSpec& spec, const Mesh& mesh);

}  // namespace lapwing
