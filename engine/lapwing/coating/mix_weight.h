#pragma once

#include <array>
#include <span>
#include <variant>
#include <vector>

#include "lapwing/coating/correspondence.h"
#include "lapwing/region/region_spec.h"
#include "lapwing/region/transition.h"

namespace lapwing {

/// The square domain's v coordinate: w is 0 up to `from` and 1 from `to` on (or the other way round
/// where `from` is the larger).
struct DomainRamp {
  double from = 0.0;
  double to = 1.0;
  bool operator==(const DomainRamp&) const = default;
};

/// Geodesic distance on the target to a region or curve: w is 1 on it and 0 from `width` on.
struct DistanceRamp {
  RegionSpec region;
  double width = 0.0;  ///< 0: w is 1 on the region and 0 elsewhere
  bool operator==(const DistanceRamp&) const = default;
};

/// w itself, painted: one number from 0 to 1 per vertex of the target mesh.
struct PaintedWeight {
  std::vector<double> field;
  bool operator==(const PaintedWeight&) const = default;
};

/// How much of the second of two sources there is, w in (1 - w) delta_A + w delta_B (paper section
/// 5.3), and how it goes from 0 to 1 over a ramp.
struct MixWeight {
  std::variant<DomainRamp, DistanceRamp, PaintedWeight> form = DomainRamp{};
  Transition::Profile profile = Transition::Profile::smooth;
  bool operator==(const MixWeight&) const = default;
};

/// Per vertex of the target mesh what w is made of there, which can be carried to other triangles
/// of the same surface: the distance to the region (never infinite), or the painted numbers; empty
/// for a domain ramp, which needs none. Throws InputError, naming `where`: a field of another
/// length or with numbers outside 0 to 1, a region without vertices, and what `resolve` throws.
std::vector<double> weight_field(const MixWeight& weight, const Mesh& mesh,
                                 const std::string& where);

/// w at each vertex of the target patch, 0 to 1. `field` is the above on the patch's mesh, `map`
/// the patch's place in the domain. Throws InputError, naming `where`: a domain ramp without the
/// square domain, a ramp without extent.
std::vector<double> mix_weights(const MixWeight& weight, std::span<const double> field,
                                const Patch& patch, const DomainMap& map, const std::string& where);

}  // namespace lapwing
