#pragma once

#include <optional>
#include <string>
#include <variant>

#include "lapwing/coating/coat_request.h"
#include "lapwing/deform/move.h"
#include "lapwing/kernels/kernels.h"
#include "lapwing/laplacian/weights.h"
#include "lapwing/region/region_spec.h"
#include "lapwing/region/transition.h"
#include "lapwing/transplant/fit_loop.h"

namespace lapwing {

/// How a part is placed: by a fit of its loop to that of the hole, or by a move from its place in
/// the file. A move without a pivot is about the centre of the part's loop.
using PartPlace = std::variant<LoopFit, Move>;

/// Parameters of a transplant. Lengths are those of the host.
struct TransplantParameters {
  /// The blend of the host's detail into the part's, from the part's loop on. Default: smooth, over
  /// half the radius of the hole, or less if other holes or handles are close.
  std::optional<Transition> transition = {};
  std::optional<double> padding =
      {};                           ///< width of the free strips beside it; default: half its width
  std::optional<double> belt = {};  ///< held width beyond; default: a quarter of its width
  LaplacianWeights weights = LaplacianWeights::cotangent;
  MappedSampling sampling = MappedSampling::linear;
  Remeshing remesh = Remeshing::automatic;
  bool operator==(const TransplantParameters&) const = default;
};

/// A request to put a part of one mesh in the place of a region of another, without the meshes.
/// {"op": "transplant"} in recipes.
struct TransplantRequest {
  std::optional<RegionSpec> part_region =
      {};                                ///< what to cut from the part's mesh; default: all of it
  std::optional<std::size_t> loop = {};  ///< which boundary loop to join; default: the longest
  PartPlace place = {};
  bool snap = false;  ///< after a move: bring the part's loop onto the mesh, by the least motion
  RegionSpec target_region = {};
  TransplantParameters parameters = {};
  std::string where = "transplant";  ///< as in RegionSpec; ignored by ==
  bool operator==(const TransplantRequest& other) const {
    return part_region == other.part_region && loop == other.loop && place == other.place &&
           snap == other.snap && target_region == other.target_region &&
           parameters == other.parameters;
  }
};

}  // namespace lapwing
