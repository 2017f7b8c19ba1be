#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lapwing/deform/modifiers/mirror.h"
#include "lapwing/deform/move.h"
#include "lapwing/elastic/deform_options.h"
#include "lapwing/region/border_belt.h"
#include "lapwing/region/edit_region.h"
#include "lapwing/region/region_spec.h"

namespace lapwing {

/// How an edit treats seams (JoinedSurface).
enum class SeamPolicy {
  join,   ///< seams remain closed; the surface is edited as if it had no seams
  leave,  ///< the sides of a seam are boundaries and can separate
};

/// How a deformation is computed, independent of its handles.
struct DeformParameters : DeformOptions {
  /// Splits a larger turn of a handle into equal substeps of at most this many degrees. The result
  /// of each substep is the rest shape of the next. Greater than 0, at most
  /// kLargestSettledTurnDegrees.
  std::optional<double> commit_every = {};
  LoosePolicy loose = LoosePolicy::carry;
  SeamPolicy seams = SeamPolicy::join;
  bool operator==(const DeformParameters&) const = default;
};

/// A file that follows the surface (AttachmentDeformer), and where its result is saved.
struct CarrySpec {
  std::filesystem::path file;       ///< path as written in the recipe
  std::filesystem::path save = {};  ///< as written in the recipe; empty: next to the result
  bool operator==(const CarrySpec&) const = default;
};

struct MovedHandle {
  RegionSpec region = {};
  Move move = {};
  Falloff falloff = {};
  HandleOrientation orientation = HandleOrientation::kept;
  /// Waypoints before `move`, each a move from the rest position. Entries with the same index in
  /// all handles belong together. For large moves, the energy has several minima, and the path
  /// determines which one is found. All paths have the same length; a handle without a path moves
  /// in equal fractions of `move`. A request that is split into substeps ignores the paths.
  std::vector<Move> path = {};
  bool operator==(const MovedHandle&) const = default;
};

/// An edit without its mesh: bends the ROI by moving its handles. In recipes, it is the step {"op":
/// "deform"}.
struct DeformRequest {
  RegionSpec roi = {};
  BeltSpec belt = BoundaryAnchors{};
  std::vector<MovedHandle> handles = {};
  TargetSpec targets = {};  ///< required if there are no handles
  /// Parts that are stiffer or softer than the rest. If several parts contain a vertex, the last
  /// one applies.
  std::vector<StiffnessSpec> stiffness = {};
  DeformParameters parameters = {};
  /// Applies the edit on both sides of a plane (`mirrored_request`).
  std::optional<MirrorSpec> mirror = {};
  /// Files that follow the surface. Steps of recipes move them; `deform` itself throws InputError
  /// if the list is not empty.
  std::vector<CarrySpec> carry = {};
  std::string where = "deform";  ///< as in RegionSpec; ignored by ==
  bool operator==(const DeformRequest& other) const {
    return roi == other.roi && belt == other.belt && handles == other.handles &&
           targets == other.targets && stiffness == other.stiffness &&
           parameters == other.parameters && mirror == other.mirror && carry == other.carry;
  }
};

/// Resolves the regions and targets of a request without a mirror on `mesh`. Throws the errors of
/// the `resolve_edit_region` in edit_region.h.
EditRegion resolve_edit_region(const DeformRequest& request, const Mesh& mesh);

}  // namespace lapwing
