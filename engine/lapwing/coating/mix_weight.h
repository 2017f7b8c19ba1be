#pragma once

#include <array>
#include <span>
#include <variant>
#include <vector>

#include "lapwing/coating/correspondence.h"
#include "lapwing/region/region_spec.h"
#include "lapwing/region/transition.h"

namespace lapwing {

/// A ramp along the square domain's v coordinate: w is 0 at `from`, 1 at `to`, and constant beyond.
/// Either may be the larger.
struct DomainRamp {
  double from = 0.0;
  double to = 1.0;
  bool operator==(const DomainRamp&) const = default;
};

/// A ramp over the geodesic distance from a region or curve: w is 1 on it and 0 from `width` on.
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

/// The share w of the second of two sources in (1 - w) delta_A + w delta_B (paper section 5.3), and
/// the profile of its ramp.
struct MixWeight {
  std::variant<DomainRamp, DistanceRamp, PaintedWeight> form = DomainRamp{};
  Transition::Profile profile = Transition::Profile::smooth;
  bool operator==(const MixWeight&) const = default;
};

/// Returns, per vertex of the target mesh, the quantity from which w is computed: the distance to
/// the region (never infinite), or the painted numbers. It can be interpolated to other triangles
/// of the same surface. Empty for a domain ramp. Throws InputError, naming `where`, if a field has
/// another length or numbers outside 0 to 1, or if a region is empty, and what `resolve` throws.
std::vector<double> weight_field(const MixWeight& weight, const Mesh& mesh,
                                 const std::string& where);

/// Returns w at each vertex of the target patch, 0 to 1. `field` is the result of `weight_field` on
/// the patch's mesh, `map` the patch's map to the domain. Throws InputError, naming `where`, if a
/// domain ramp has no extent or the domain is not the square.
std::vector<double> mix_weights(const MixWeight& weight, std::span<const double> field,
                                const Patch& patch, const DomainMap& map, const std::string& where);

}  // namespace lapwing
