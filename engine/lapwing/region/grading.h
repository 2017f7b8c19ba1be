#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lapwing/mesh/mesh.h"
#include "lapwing/region/region_spec.h"
#include "lapwing/region/transition.h"

namespace lapwing {

/// How firmly a handle holds its vertices, and those around it.
struct Grading {
  double weight = 1.0;  ///< times the constraint weight; above 0; has no effect on hard constraints
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

/// Throws InputError, naming `where`: a weight that is not above 0, a falloff of a width below 0, a
/// falloff beside a field, numbers that are not finite.
void require_grading(const Grading& grading, const std::string& where);

/// Where a field puts a handle: `full` are the vertices of `region` with weight 1, the others above
/// 0 go to `graded`. `field` has a number from 0 to 1 for each vertex of the mesh. Throws
/// InputError, naming `where`, for a region in which no vertex has weight 1.
void split_by_field(const VertexSet& region, std::span<const double> field, std::size_t handle,
                    const std::string& where, VertexSet& full, std::vector<GradedVertex>& graded);

/// The vertices around `handle` by its falloff, which pass no vertex off `allowed` (a mark per
/// vertex) and hold none of the handle's own.
std::vector<GradedVertex> falloff_of(const VertexSet& handle, const Transition& falloff,
                                     std::size_t number, std::span<const char> allowed,
                                     const Mesh& mesh);

/// At most one entry per vertex, ascending: where two handles reach, that of the larger weight.
/// Where both weigh the same, none: the middle between two handles goes with neither.
std::vector<GradedVertex> without_shared(std::vector<GradedVertex> graded);

}  // namespace lapwing
