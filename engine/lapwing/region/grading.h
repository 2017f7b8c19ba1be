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

/// What the weights of belt, handles and targets may be. Squared, a smaller one holds nothing
/// beside the rounding of the surface's own forces; a larger one holds no firmer, since already
/// this one leaves nothing of the error.
inline constexpr double kLeastWeight = 1e-6;
inline constexpr double kMostWeight = 1e12;

constexpr bool is_weight(double number) {
  return number >= kLeastWeight && number <= kMostWeight;
}
/// The same for messages.
inline constexpr std::string_view kWeightWords = "a weight from 0.000001 to 1000000000000";

/// How firmly a handle holds its vertices, and those around it.
struct Grading {
  /// Times the constraint weight, in the range of weights; has no effect on hard constraints.
  double weight = 1.0;
  /// Beyond the handle's region its weight falls from 1 to 0 over this geodesic distance. Without a
  /// width: nowhere.
  std::optional<Transition> falloff = {};
  /// In place of that, painted: a weight from 0 to 1 for each vertex of the mesh, which counts
  /// inside the region. 0 leaves a vertex free.
  std::vector<double> field = {};

  bool operator==(const Grading&) const = default;
};

struct HandleSpec {
  RegionSpec region;
  Grading grading = {};
};

/// A vertex that goes with a handle by less than its full weight.
struct GradedVertex {
  Index vertex = 0;
  std::size_t handle = 0;
  double weight = 0.0;  ///< above 0, below 1
  bool operator==(const GradedVertex&) const = default;
};

/// Throws InputError, naming `where`: a weight out of its range, a falloff of a width below 0, a
/// falloff beside a field, numbers that are not finite.
void require_grading(const Grading& grading, const std::string& where);

/// Where a field puts a handle: `full` are the vertices of `region` with weight 1, the others above
/// 0 go to `graded`. `field` has a number from 0 to 1 for each vertex of the mesh. Throws
/// InputError, naming `where`, for a region in which no vertex has weight 1.
void split_by_field(const VertexSet& region, std::span<const double> field, std::size_t handle,
                    const std::string& where, VertexSet& full, std::vector<GradedVertex>& graded);

/// A handle whose full vertices are known, and how it fades around them.
struct FadingHandle {
  VertexSet full;
  std::optional<Transition> falloff = {};
};

/// What handles hold by less than their full weight: the vertices that they are `painted` on, and
/// those around each by its falloff, which ends at the rim of `roi`, at the other handles and at
/// `held`, none of which is graded. At most one entry per vertex, ascending: where two handles
/// reach, that of the larger weight. Where both weigh the same, none: the middle between two
/// handles goes with neither. Costs nothing where nothing is painted or fades.
std::vector<GradedVertex> graded_around(std::span<const FadingHandle> handles,
                                        std::vector<GradedVertex> painted, const VertexSet& roi,
                                        std::span<const Index> held, const Mesh& mesh);

}  // namespace lapwing
