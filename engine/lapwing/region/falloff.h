#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lapwing/mesh/mesh.h"
#include "lapwing/region/region_spec.h"
#include "lapwing/region/transition.h"

namespace lapwing {

/// Limits of the weights of belt, handles and targets. The square of a smaller weight is below the
/// rounding errors of the surface's forces. A larger weight has no further effect, because the
/// constraint error is already 0.
inline constexpr double kMinWeight = 1e-6;
inline constexpr double kMaxWeight = 1e12;

constexpr bool is_weight(double number) {
  return number >= kMinWeight && number <= kMaxWeight;
}
/// The range in words, for messages.
inline constexpr std::string_view kWeightWords = "a weight from 0.000001 to 1000000000000";

/// How firmly a handle holds its vertices and those around it.
struct Falloff {
  /// The handle's weight is this factor, from kMinWeight to kMaxWeight, times the constraint weight
  /// (1 if the edit has none). If the factor is empty, the handle has the constraint weight, or is
  /// stiff (kStiff) if the edit has none. Hard constraints ignore the factor.
  std::optional<double> weight = {};
  /// Outside the handle's region, its weight falls from 1 to 0 over this geodesic distance. There
  /// is no falloff if this is empty or its width is 0.
  std::optional<Transition> transition = {};
  /// Painted weights from 0 to 1 for each vertex of the mesh, instead of a falloff. They count
  /// inside the region, where 0 leaves a vertex free.
  std::vector<double> field = {};

  bool operator==(const Falloff&) const = default;
};

struct HandleSpec {
  RegionSpec region;
  Falloff falloff = {};
};

/// A vertex that follows a handle with less than its full weight.
struct FalloffVertex {
  Index vertex = 0;
  std::size_t handle = 0;
  double weight = 0.0;  ///< in the open interval (0, 1)
  bool operator==(const FalloffVertex&) const = default;
};

/// Throws InputError, naming `where`, if the weight is outside its range, if the width of the
/// falloff is negative or not finite, or if there are both a falloff and a field.
void require_falloff(const Falloff& falloff, const std::string& where);

/// Splits the vertices of `region` by `field`, which has a weight from 0 to 1 for each vertex of
/// the mesh. `full` becomes those with weight 1; those between 0 and 1 are added to `graded`.
/// Throws InputError, naming `where`, if no vertex of the region has weight 1.
void split_by_field(const VertexSet& region, std::span<const double> field, std::size_t handle,
                    const std::string& where, VertexSet& full, std::vector<FalloffVertex>& graded);

/// The vertices that a handle holds with full weight, and its falloff around them.
struct FadingHandle {
  VertexSet full;
  std::optional<Transition> falloff = {};
};

/// Returns the vertices that handles hold with less than full weight: those in `painted` and those
/// in falloffs. A falloff ends at the rim of `roi`, at other handles and at `held`, whose vertices
/// are not graded. There is at most one entry per vertex, ascending. If two handles reach a vertex,
/// the larger weight counts; if both weigh the same, the vertex follows neither. Costs nothing if
/// nothing is painted or fades.
std::vector<FalloffVertex> falloff_around(std::span<const FadingHandle> handles,
                                          std::vector<FalloffVertex> painted, const VertexSet& roi,
                                          std::span<const Index> held, const Mesh& mesh);

}  // namespace lapwing
