#pragma once

#include <array>
#include <span>
#include <variant>
#include <vector>

#include "lapwing/coating/correspondence.h"
#include "lapwing/region/region_spec.h"
#include "lapwing/region/transition.h"

namespace lapwing {

/// A ramp along the v coordinate of the square domain: w is 0 at `from`, 1 at `to`, and constant
/// outside this interval. `from` may be larger than `to`.
struct DomainRamp {
  double from = 0.0;
  double to = 1.0;
  bool operator==(const DomainRamp&) const = default;
};

/// A ramp over the geodesic distance from a region or curve: w is 1 on it and 0 at distances of at
/// least `width`.
struct DistanceRamp {
  RegionSpec region;
  double width = 0.0;  ///< if 0, w is 1 on the region and 0 elsewhere
  bool operator==(const DistanceRamp&) const = default;
};

/// Given values of w: one number from 0 to 1 per vertex of the target mesh.
struct PaintedWeight {
  std::vector<double> field;
  bool operator==(const PaintedWeight&) const = default;
};

/// The weight w of the second source in (1 - w) delta_A + w delta_B (paper section 5.3), and the
/// profile of its ramp.
struct MixWeight {
  std::variant<DomainRamp, DistanceRamp, PaintedWeight> form = DomainRamp{};
  Transition::Profile profile = Transition::Profile::smooth;
  bool operator==(const MixWeight&) const = default;
};

/// Returns, per vertex of the target mesh, the quantity from which w is computed: the distance to
/// the region (always finite), or the painted values. Remeshing can interpolate it. Empty for a
/// domain ramp. Throws InputError, naming `where`, if a field has a wrong length or values outside
/// [0, 1], or if a region is empty, and the errors of `resolve`.
std::vector<double> weight_field(const MixWeight& weight, const Mesh& mesh,
                                 const std::string& where);

/// Returns w, from 0 to 1, at each vertex of the target patch. `field` is the result of
/// `weight_field` for the patch's mesh, and `map` is the patch's map to the domain. Throws
/// InputError, naming `where`, if a domain ramp has length 0 or the domain is not the square.
std::vector<double> mix_weights(const MixWeight& weight, std::span<const double> field,
                                const Patch& patch, const DomainMap& map, const std::string& where);

}  // namespace lapwing
