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

/// What becomes of seams (JoinedSurface) in an edit.
enum class SeamPolicy {
  join,   ///< the surface is edited as if it had none, and they stay closed
  leave,  ///< their sides are boundaries, and move apart
};

/// How a deformation is computed, whatever it moves.
struct DeformParameters : DeformOptions {
  /// A larger turn of a handle is made in equal parts of at most this many degrees, each committed:
  /// its result is the rest shape of the next. Above 0, at most kLargestSettledTurnDegrees.
  std::optional<double> commit_every = {};
  LoosePolicy loose = LoosePolicy::carry;
  SeamPolicy seams = SeamPolicy::join;
  bool operator==(const DeformParameters&) const = default;
};

/// A file that follows the surface (SurfaceCarrier), and where it goes.
struct CarrySpec {
  std::filesystem::path file;       ///< as written
  std::filesystem::path save = {};  ///< as written; empty: beside the result
  bool operator==(const CarrySpec&) const = default;
};

struct MovedHandle {
  RegionSpec region;
  Move move;
  Grading grading = {};
  HandleOrientation orientation = HandleOrientation::kept;
  /// Moves that the handle went through before `move`, each from the rest position. Moves at the
  /// same place in the lists of all handles belong together. Far moves have several results; the
  /// result is the one that this path leads to. All paths have the same length; a handle without
  /// one goes by equal shares of its move. A request that is carried out in several parts ignores
  /// the paths.
  std::vector<Move> path = {};
  bool operator==(const MovedHandle&) const = default;
};

/// Bend the ROI by moving its handles: all of an edit but the mesh. {"op": "deform"} in recipes.
struct DeformRequest {
  RegionSpec roi;
  BeltSpec belt = BorderBelt{};
  std::vector<MovedHandle> handles;
  TargetSpec targets;  ///< with the handles, at least one
  DeformParameters parameters;
  /// All of the above is done on both sides of a plane (`mirrored_request`).
  std::optional<MirrorSpec> mirror = {};
  /// Files that follow the surface. Steps of recipes carry them; `deform` itself throws InputError
  /// if there are any.
  std::vector<CarrySpec> carry = {};
  std::string where = "deform";  ///< as in RegionSpec; no part of the value
  bool operator==(const DeformRequest& other) const {
    return roi == other.roi && belt == other.belt && handles == other.handles &&
           targets == other.targets && parameters == other.parameters && mirror == other.mirror &&
           carry == other.carry;
  }
};

/// What the regions and targets of a request without a mirror come to on `mesh`. Throws what the
/// other `resolve_edit_region` does.
EditRegion resolve_edit_region(const DeformRequest& request, const Mesh& mesh);

}  // namespace lapwing
