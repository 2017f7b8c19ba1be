#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "lapwing/mesh/surface_point.h"
#include "lapwing/parameterize/domain_map.h"
#include "lapwing/parameterize/warp.h"

namespace lapwing {

/// Vertices that belong together: of the source mesh and of the target mesh.
using VertexPair = std::array<Index, 2>;

struct CorrespondenceOptions {
  Domain domain = Domain::disk;
  /// On the boundaries: one for the disk, four in order around for the square. None: pins are
  /// chosen (`default_pins`), and the source's map is turned so that inner pairs come near each
  /// other.
  std::vector<VertexPair> boundary_pairs;
  std::vector<VertexPair> inner_pairs;  ///< inside, as many as wanted
  bool operator==(const CorrespondenceOptions&) const = default;
};

/// A patch and where its own vertices are in space.
struct PlacedPatch {
  const Patch& patch;
  std::span<const Eigen::Vector3d> positions;
};

/// How a target patch lies on a source patch, through a common domain (paper section 5.2).
struct Correspondence {
  DomainMap source;  ///< bent so that the inner pairs meet
  DomainMap target;
  std::vector<VertexPair> pins;    ///< the boundary pairs that were used, mesh numbers
  WarpReport warp;                 ///< of the source's map
  std::size_t flipped_source = 0;  ///< triangles that the maps turned over or flattened
  std::size_t flipped_target = 0;
  std::vector<SurfacePoint> points;  ///< per own number of the target: own numbers of the source
};

enum class MapSide { source, target };

/// A patch in the domain, before it is bent to meet another.
struct LaidPatch {
  BoundaryPins pins;
  bool pins_are_chosen = false;  ///< rather than given
  DomainMap map;
};

/// The first half of `correspond`, one side by itself. Throws what that does.
LaidPatch lay(const PlacedPatch& side, MapSide which, const CorrespondenceOptions& options,
              const std::string& where);
/// The second half.
Correspondence correspond(const PlacedPatch& source, LaidPatch laid_source,
                          const PlacedPatch& target, LaidPatch laid_target,
                          const CorrespondenceOptions& options, const std::string& where);

/// Parameterizes both patches, bends the source's map until the inner pairs meet, and locates every
/// vertex of the target. Throws InputError, naming `where` and the pair, when a pair names a vertex
/// outside its patch or off its boundary (inside it, for inner pairs), when the number of boundary
/// pairs does not fit the domain or their order goes around the wrong way, and when inner pairs
/// contradict each other.
Correspondence correspond(const PlacedPatch& source, const PlacedPatch& target,
                          const CorrespondenceOptions& options, const std::string& where);

}  // namespace lapwing
