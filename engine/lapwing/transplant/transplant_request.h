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

/// Placement of a part: a fit of its loop to the hole's loop, or a move from its position in the
/// file. The default pivot of a move is the centre of the part's loop.
using PartPlace = std::variant<LoopFit, Move>;

/// Parameters of a transplant. Lengths are in units of the host.
struct TransplantParameters {
  /// The transition from the host's detail to the part's detail, which begins at the part's loop.
  /// By default, it is smooth, and its width is half the radius of the hole, or less if other holes
  /// or topological handles are close.
  std::optional<Transition> transition = {};
  std::optional<double> padding =
      {};  ///< width of the free zone next to the transition; default: half the transition's width
  std::optional<double> belt = {};  ///< width of the belt; default: 1/4 of the transition's width
  LaplacianWeights weights = LaplacianWeights::cotangent;
  MappedSampling sampling = MappedSampling::linear;
  Remeshing remesh = Remeshing::automatic;
  bool operator==(const TransplantParameters&) const = default;
};

/// A request to replace a region of one mesh by a part of another mesh. It does not contain the
/// meshes. {"op": "transplant"} in recipes.
struct TransplantRequest {
  std::optional<RegionSpec> part_region =
      {};  ///< region to cut from the part's mesh; default: the whole mesh
  std::optional<std::size_t> loop = {};  ///< boundary loop to join; default: the longest
  PartPlace place = {};
  bool snap = false;  ///< whether to move the part's loop onto the mesh by a small motion
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
