#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "lapwing/deform/modifiers/mirror.h"
#include "lapwing/mesh/mesh.h"
#include "lapwing/mesh/seams.h"
#include "lapwing/region/border_belt.h"
#include "lapwing/region/falloff.h"
#include "lapwing/region/region_spec.h"

namespace lapwing::viewer {

/// Vertices that a user chose, and how, so that a recipe can describe them.
/// `resolve(spec_of(region))` returns `vertices` on the mesh on which they were chosen.
struct ChosenRegion {
  RegionSpec made{ListedVertices{}, "selection"};  ///< the first choice: a disk, a loop, a box, ...
  VertexSet added;                                 ///< added by hand; not in `made`
  VertexSet removed;                               ///< removed by hand; in `made`
  VertexSet vertices;                              ///< the result

  bool operator==(const ChosenRegion&) const = default;
};

/// Returns the region that `spec` describes on a mesh. If seams are `joined`, it holds their
/// leaders only. Throws what `resolve` throws.
ChosenRegion choose(RegionSpec spec, const Mesh& mesh, const JoinedSurface* joined = nullptr);

/// Returns the region changed by hand to hold `vertices`.
ChosenRegion repainted(const ChosenRegion& region, VertexSet vertices);

/// Returns the region as a recipe writes it; messages call it `where`.
RegionSpec spec_of(const ChosenRegion& region, const std::string& where);

/// Returns the same vertices on a mesh that has moved. They become a list if `made` would mean
/// others there.
ChosenRegion carried_over(const ChosenRegion& region, const Mesh& mesh,
                          const JoinedSurface* joined = nullptr);

/// A handle, and how firmly it holds.
struct ChosenHandle : ChosenRegion {
  Falloff falloff;

  ChosenHandle() = default;
  ChosenHandle(ChosenRegion region) : ChosenRegion(std::move(region)) {}
  bool operator==(const ChosenHandle&) const = default;
};

/// Returns the vertices that the handle holds with full weight. It turns and scales about them.
VertexSet fully_held(const ChosenHandle& handle);

/// The regions of the next edit. Any of them may still be missing.
struct EditSelection {
  ChosenRegion roi;
  std::vector<ChosenHandle> handles;
  /// The belt's width as a fraction of the ROI's radius. If not set, the belt was chosen by hand.
  std::optional<double> belt_fraction = BoundaryAnchors{}.fraction;
  ChosenRegion belt;
  /// The selection applies to both sides of this plane.
  std::optional<MirrorPlane> mirror;

  bool operator==(const EditSelection&) const = default;
};

/// Fits a belt that is given by its width to the ROI and the handles. A belt chosen by hand stays.
/// The cost is linear in the ROI, besides that of the geodesic distances.
void renew_belt(EditSelection& selection, const Mesh& mesh, const JoinedSurface* joined = nullptr);

/// Returns the vertices that handles hold with less than full weight, as `resolve_edit_region`
/// finds them, without hard targets.
std::vector<FalloffVertex> falloff_vertices(const EditSelection& selection, const Mesh& mesh);

BeltSpec belt_spec(const EditSelection& selection);
std::vector<HandleSpec> handle_specs(const EditSelection& selection);

}  // namespace lapwing::viewer
