#pragma once

#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "lapwing/mesh/mesh.h"
#include "lapwing/region/region_spec.h"

namespace lapwing {

/// The stiffness factor of rigid vertices. Each connected part of such vertices moves as one body.
inline constexpr double kRigidStiffness = std::numeric_limits<double>::infinity();
/// Range of the other stiffness factors.
inline constexpr double kSoftest = 0.01;
inline constexpr double kStiffest = 100.0;

constexpr bool is_stiffness(double factor) {
  return factor == kRigidStiffness || (factor >= kSoftest && factor <= kStiffest);
}
/// The valid factors as text, for messages.
inline constexpr std::string_view kStiffnessWords = "a factor from 0.01 to 100, or \"rigid\"";

/// A part of the surface that is stiffer or softer than the rest (ENERGY.md section 3).
struct StiffnessSpec {
  RegionSpec region = {};
  double factor = kRigidStiffness;
  /// Painted factors for each vertex of the mesh, instead of `factor`. They are used inside the
  /// region.
  std::vector<double> field = {};
  bool operator==(const StiffnessSpec&) const = default;
};

/// A vertex whose stiffness factor is not 1.
struct VertexStiffness {
  Index vertex = 0;
  double factor = 1.0;
  bool operator==(const VertexStiffness&) const = default;
};

/// Returns the vertices of `roi` whose factor is not 1, ascending. If several specs contain a
/// vertex, the last one determines its factor. Throws InputError, naming the location, for a factor
/// that is not `is_stiffness`, and if a field does not have a factor for each vertex. Also throws
/// the errors of `resolve`.
std::vector<VertexStiffness> resolve_stiffness(std::span<const StiffnessSpec> specs,
                                               const VertexSet& roi, const Mesh& mesh);

}  // namespace lapwing
