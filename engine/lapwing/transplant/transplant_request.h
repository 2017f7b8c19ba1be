#pragma once

#include <optional>
#include <string>
#include <variant>

#include "lapwing/coating/coat_parameters.h"
#include "lapwing/deform/move.h"
#include "lapwing/kernels/kernels.h"
#include "lapwing/laplacian/weights.h"
#include "lapwing/region/region_spec.h"
#include "lapwing/region/transition.h"
#include "lapwing/transplant/fit_loop.h"

namespace lapwing {

/// Where a part comes to: by itself, its loop on that of the hole; or moved from where it is in its
/// file, a move without pivot about the centre of the part's loop.
using PartPlace = std::variant<LoopFit, Move>;

/// How a transplant is computed. Lengths are on the mesh that the part is put on.
struct TransplantParameters {
  /// How far over the part the host's detail goes over into the part's; none: half the radius of
  /// the hole, or as much of it as other holes and handles leave room for, and smooth.
  std::optional<Transition> transition;
  std::optional<double> padding;  ///< free on both sides beyond it; none: half the transition
  std::optional<double> belt;     ///< held beyond that; none: a quarter of it
  LaplacianWeights weights = LaplacianWeights::cotangent;
  MappedSampling sampling = MappedSampling::linear;
  Remeshing remesh = Remeshing::automatic;
  bool operator==(const TransplantParameters&) const = default;
};

/// Put a part of one mesh in the place of a region of another: all of it but the meshes.
/// {"op": "transplant"} in recipes.
struct TransplantRequest {
  std::optional<RegionSpec> part_region;  ///< what is cut from the part's mesh; all if not given
  std::optional<std::size_t> loop;        ///< which boundary loop is sewn on; the longest
  PartPlace place;
  bool snap = false;  ///< after a move: its loop is brought onto the mesh, by the least motion
  RegionSpec target_region;
  TransplantParameters parameters;
  std::string where = "transplant";  ///< as in RegionSpec; no part of the value
  bool operator==(const TransplantRequest& other) const {
    return part_region == other.part_region && loop == other.loop && place == other.place &&
           snap == other.snap && target_region == other.target_region &&
           parameters == other.parameters;
  }
};

}  // namespace lapwing
