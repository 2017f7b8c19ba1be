#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "lapwing/mesh/closest_point.h"
#include "lapwing/parameterize/domain_map.h"
#include "lapwing/parameterize/warp.h"

namespace lapwing {

/// Corresponding vertices of the source mesh and of the target mesh.
using VertexPair = std::array<Index, 2>;

struct CorrespondenceOptions {
  Domain domain = Domain::disk;
  /// Pairs of boundary vertices: one for the disk, four in loop order for the square. If empty,
  /// `default_pins` chooses pins, and the source's map is rotated to bring inner pairs close.
  std::vector<VertexPair> boundary_pairs;
  std::vector<VertexPair> inner_pairs;  ///< any number of pairs inside the patches
  bool operator==(const CorrespondenceOptions&) const = default;
};

/// A patch and the positions of its vertices.
struct PlacedPatch {
  const Patch& patch;
  std::span<const Eigen::Vector3d> positions;
};

/// A map from a target patch to a source patch through a common domain (paper section 5.2).
struct Correspondence {
  DomainMap source;  ///< warped so that the vertices of inner pairs coincide
  DomainMap target;
  std::vector<VertexPair> pins;    ///< the boundary pairs that were used, as mesh vertices
  WarpReport warp;                 ///< of the source's map
  std::size_t flipped_source = 0;  ///< number of triangles that the maps flipped or flattened
  std::size_t flipped_target = 0;
  /// By local index of the target; with local indices of the source.
  std::vector<SurfacePoint> points;
};

enum class MapSide { source, target };

/// A patch mapped to the domain, before warping.
struct FlattenedPatch {
  BoundaryPins pins;
  bool pins_are_chosen = false;  ///< whether default_pins chose the pins
  DomainMap map;
};

/// The first half of `correspond`: parameterizes one patch. Throws the errors of `correspond`.
FlattenedPatch lay(const PlacedPatch& side, MapSide which, const CorrespondenceOptions& options,
                   const std::string& where);
/// The second half of `correspond`: warps and locates.
Correspondence correspond(const PlacedPatch& source, FlattenedPatch laid_source,
                          const PlacedPatch& target, FlattenedPatch laid_target,
                          const CorrespondenceOptions& options, const std::string& where);

/// Parameterizes both patches, warps the source's map until the inner pairs meet, and locates every
/// vertex of the target on the source. Throws InputError, naming `where` and the pair, if a vertex
/// is not in its patch, a boundary pair is not on the boundaries, an inner pair is not inside, the
/// boundary pairs have a wrong number or orientation, or inner pairs contradict each other.
Correspondence correspond(const PlacedPatch& source, const PlacedPatch& target,
                          const CorrespondenceOptions& options, const std::string& where);

}  // namespace lapwing
