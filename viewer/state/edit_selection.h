#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "lapwing/deform/modifiers/mirror.h"
#include "lapwing/mesh/joined_surface.h"
#include "lapwing/mesh/mesh.h"
#include "lapwing/region/border_belt.h"
#include "lapwing/region/grading.h"
#include "lapwing/region/region_spec.h"

namespace lapwing::viewer {

/// Vertices that a person chose, and how, so that a recipe can say it. `resolve(spec_of(region))`
/// gives `vertices` on the mesh that they were chosen on.
struct ChosenRegion {
  RegionSpec made{ListedVertices{}, "selection"};  ///< how it began: a disk, a loop, a box, ...
  VertexSet added;                                 ///< by hand since; not in `made`
  VertexSet removed;                               ///< by hand since; in `made`
  VertexSet vertices;                              ///< what all that comes to

  bool operator==(const ChosenRegion&) const = default;
};

/// The region that `spec` says on a mesh; where that has seams and they are `joined`, the leaders
/// that it says there. Throws what `resolve` does.
ChosenRegion choose(RegionSpec spec, const Mesh& mesh, const JoinedSurface* joined = nullptr);

/// The region changed by hand to hold `vertices`.
ChosenRegion repainted(const ChosenRegion& region, VertexSet vertices);

/// The region as a recipe writes it; messages call it `where`.
RegionSpec spec_of(const ChosenRegion& region, const std::string& where);

/// The same vertices on a mesh that has moved, where `made` may now say others: then they are
/// listed.
ChosenRegion carried_over(const ChosenRegion& region, const Mesh& mesh,
                          const JoinedSurface* joined = nullptr);

/// A handle, and how firmly it holds.
struct ChosenHandle : ChosenRegion {
  Grading grading;

  ChosenHandle() = default;
  ChosenHandle(ChosenRegion region) : ChosenRegion(std::move(region)) {}
  bool operator==(const ChosenHandle&) const = default;
};

/// Those that the handle holds with all its weight: what it turns and scales about.
VertexSet fully_held(const ChosenHandle& handle);

struct EditSelection;
/// The vertices that its handles hold by less than all their weight, as `resolve_edit_region` finds
/// them, hard targets left aside.
std::vector<GradedVertex> graded_vertices(const EditSelection& selection, const Mesh& mesh);

/// What the next edit concerns. Any part may still be missing.
struct EditSelection {
  ChosenRegion roi;
  std::vector<ChosenHandle> handles;
  /// The belt's width as a fraction of the ROI's radius; without it the belt was chosen by hand.
  std::optional<double> belt_fraction = BorderBelt{}.fraction;
  ChosenRegion belt;
  /// All of it is meant on both sides of this plane.
  std::optional<MirrorPlane> mirror;

  bool operator==(const EditSelection&) const = default;
};

/// Makes a belt that goes by its width fit the ROI and the handles; any other stays. Linear in the
/// ROI but for the geodesic distances.
void renew_belt(EditSelection& selection, const Mesh& mesh, const JoinedSurface* joined = nullptr);

BeltSpec belt_spec(const EditSelection& selection);
std::vector<HandleSpec> handle_specs(const EditSelection& selection);

}  // namespace lapwing::viewer
