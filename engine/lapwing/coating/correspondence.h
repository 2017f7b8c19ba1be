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
  /// On the boundaries: one for the disk, four in order around for the square. If empty, pins are
  /// chosen (`default_pins`), and the source's map is rotated to bring inner pairs close.
  std::vector<VertexPair> boundary_pairs;
  std::vector<VertexPair> inner_pairs;  ///< inside the patches, any number
  bool operator==(const CorrespondenceOptions&) const = default;
};

/// A patch and the positions of its vertices.
struct PlacedPatch {
  const Patch& patch;
  std::span<const Eigen::Vector3d> positions;
};

/// A map from a target patch to a source patch through a common domain (paper section 5.2).
struct Correspondence {
  DomainMap source;  ///< warped so that the inner pairs meet
  DomainMap target;
  std::vector<VertexPair> pins;    ///< the boundary pairs that were used, in mesh vertices
  WarpReport warp;                 ///< of the source's map
  std::size_t flipped_source = 0;  ///< triangles that the maps turned over or flattened
  std::size_t flipped_target = 0;
  std::vector<SurfacePoint> points;  ///< per own number of the target, in own numbers of the source
};

enum class MapSide { source, target };

/// A patch mapped to the domain, before any warp.
struct FlattenedPatch {
  BoundaryPins pins;
  bool pins_are_chosen = false;  ///< by default_pins, rather than given
  DomainMap map;
};

/// The first half of `correspond`, for one side. Throws what `correspond` throws.
FlattenedPatch lay(const PlacedPatch& side, MapSide which, const CorrespondenceOptions& options,
                   const std::string& where);
/// The second half, which brings both sides together.
Correspondence correspond(const PlacedPatch& source, FlattenedPatch laid_source,
                          const PlacedPatch& target, FlattenedPatch laid_target,
                          const CorrespondenceOptions& options, const std::string& where);

/// Parameterizes both patches, warps the source's map until the inner pairs meet, and locates every
/// vertex of the target on the source. Throws InputError, naming `where` and the pair, if a vertex
/// is outside its patch, or off its boundary (on it, for inner pairs); if the number of boundary
/// pairs does not fit the domain, or they go around the wrong way; and if inner pairs contradict
/// each other.
Correspondence correspond(const PlacedPatch& source, const PlacedPatch& target,
                          const CorrespondenceOptions& options, const std::string& where);

}  // namespace lapwing
