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

/// Limits of the weights of belt, handles and targets. The square of a smaller weight would be
/// below the rounding errors of the surface's forces. A larger weight would have no further effect,
/// because the constraint error is already 0.
inline constexpr double kMinWeight = 1e-6;
inline constexpr double kMaxWeight = 1e12;

constexpr bool is_weight(double number) {
  return number >= kMinWeight && number <= kMaxWeight;
}
/// The range as text, for messages.
inline constexpr std::string_view kWeightWords = "a weight from 0.000001 to 1000000000000";

/// The weights with which a handle holds its vertices and the vertices around them.
struct Falloff {
  /// The handle's weight is this factor, from kMinWeight to kMaxWeight, times the constraint weight
  /// (1 if the edit has none). If it is empty, the handle has the constraint weight or, if the edit
  /// has none, is stiff (kStiff). Hard constraints ignore the factor.
  std::optional<double> weight = {};
  /// Outside the handle's region, the weight decreases from 1 to 0 over this geodesic distance.
  /// There is no falloff if this is empty or its width is 0.
  std::optional<Transition> transition = {};
  /// Painted weights from 0 to 1 for each vertex of the mesh, instead of a falloff. They are used
  /// inside the region; a vertex with weight 0 is free.
  std::vector<double> field = {};

  bool operator==(const Falloff&) const = default;
};

struct HandleSpec {
  RegionSpec region;
  Falloff falloff = {};
};

/// A vertex that follows a handle with a weight below 1.
struct FalloffVertex {
  Index vertex = 0;
  std::size_t handle = 0;
  double weight = 0.0;  ///< in the open interval (0, 1)
  bool operator==(const FalloffVertex&) const = default;
};

/// Throws InputError, naming `where`, if the weight is outside its range, if the width of the
/// falloff is negative or not finite, or if there are both a falloff and a field.
void require_falloff(const Falloff& falloff, const std::string& where);

/// Classifies the vertices of `region` by `field`, which has a weight from 0 to 1 for each vertex
/// of the mesh. Sets `full` to the vertices with weight 1, and adds vertices with weights between 0
/// and 1 to `graded`. Throws InputError, naming `where`, if no vertex of the region has weight 1.
void split_by_field(const VertexSet& region, std::span<const double> field, std::size_t handle,
                    const std::string& where, VertexSet& full, std::vector<FalloffVertex>& graded);

/// The vertices that a handle holds with weight 1, and the falloff around them.
struct FadingHandle {
  VertexSet full;
  std::optional<Transition> falloff = {};
};

/// Returns the vertices that handles hold with weights below 1: the vertices in `painted` and in
/// falloffs. A falloff ends at the border of `roi`, at other handles and at `held`, whose vertices
/// are not graded. There is at most one entry per vertex, ascending. If two handles reach a vertex,
/// it follows the handle with the larger weight, or neither if the weights are equal. No cost if
/// there are neither painted weights nor falloffs.
std::vector<FalloffVertex> falloff_around(std::span<const FadingHandle> handles,
                                          std::vector<FalloffVertex> painted, const VertexSet& roi,
                                          std::span<const Index> held, const Mesh& mesh);

}  // namespace lapwing
