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
#include "lapwing/region/stiffness.h"

namespace lapwing::viewer {

/// Vertices that the user has chosen, with the choices that led to them, for a recipe. On the mesh
/// on which they were chosen, `resolve(spec_of(region))` returns `vertices`.
struct ChosenRegion {
  RegionSpec made{ListedVertices{}, "selection"};  ///< the first choice: a disk, a loop, a box, ...
  VertexSet added;                                 ///< vertices outside `made`, added by hand
  VertexSet removed;                               ///< vertices of `made`, removed by hand
  VertexSet vertices;                              ///< `made` plus `added` minus `removed`

  bool operator==(const ChosenRegion&) const = default;
};

/// Returns the region that `spec` describes on a mesh. If `joined` is not null, the region contains
/// only the leaders of joined vertices. Throws the errors of `resolve`.
ChosenRegion choose(RegionSpec spec, const Mesh& mesh, const JoinedSurface* joined = nullptr);

/// Returns the region after a change by hand, with `vertices` as its vertices.
ChosenRegion repainted(const ChosenRegion& region, VertexSet vertices);

/// Returns the region in the form of a recipe. `where` is its name in messages.
RegionSpec spec_of(const ChosenRegion& region, const std::string& where);

/// Returns a region with the same vertices after the mesh has moved to `mesh`. If `made` describes
/// other vertices on `mesh`, the result is a vertex list.
ChosenRegion carried_over(const ChosenRegion& region, const Mesh& mesh,
                          const JoinedSurface* joined = nullptr);

/// A handle with its weights.
struct ChosenHandle : ChosenRegion {
  Falloff falloff;

  ChosenHandle() = default;
  ChosenHandle(ChosenRegion region) : ChosenRegion(std::move(region)) {}
  bool operator==(const ChosenHandle&) const = default;
};

/// Returns the vertices that the handle holds with full weight. Their centroid is the default
/// pivot.
VertexSet fully_held(const ChosenHandle& handle);

/// The regions of the next edit. A region that is not selected yet is empty.
struct EditSelection {
  ChosenRegion roi;
  std::vector<ChosenHandle> handles;
  /// The belt's width as a fraction of the ROI's radius. If not set, the belt was chosen by hand.
  std::optional<double> belt_fraction = BoundaryAnchors{}.fraction;
  ChosenRegion belt;
  std::vector<Index> held_holes;  ///< BorderBelt::held_holes of a belt with a width
  /// If set, the edit is applied to both sides of this plane.
  std::optional<MirrorPlane> mirror;
  /// DeformRequest::stiffness. The next edit keeps it.
  std::vector<StiffnessSpec> stiffness;

  bool operator==(const EditSelection&) const = default;
};

/// Recomputes the belt from its width, the ROI and the handles. Does not change a belt that was
/// chosen by hand. The cost is linear in the size of the ROI, plus that of geodesic distances.
void renew_belt(EditSelection& selection, const Mesh& mesh, const JoinedSurface* joined = nullptr);

/// Returns the vertices that handles hold with less than full weight. The result is that of
/// `resolve_edit_region` without hard targets.
std::vector<FalloffVertex> falloff_vertices(const EditSelection& selection, const Mesh& mesh);

/// Returns `stiffness` with the factor of `vertices` set to `factor`. Painted vertices are lists,
/// one for each factor.
std::vector<StiffnessSpec> painted_stiffness(std::vector<StiffnessSpec> stiffness,
                                             const VertexSet& vertices, double factor);

BeltSpec belt_spec(const EditSelection& selection);
std::vector<HandleSpec> handle_specs(const EditSelection& selection);

}  // namespace lapwing::viewer
