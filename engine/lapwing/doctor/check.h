#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "lapwing/doctor/statistics.h"
#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// Kinds of defects, and of facts worth knowing before an edit, in the order of the report.
enum class DefectKind {
  no_faces,
  non_finite_vertex,
  degenerate_face,
  repeated_face,
  zero_area_face,
  loose_vertex,
  duplicate_vertex,
  unwelded_seam,
  non_manifold_edge,
  bow_tie_vertex,
  inconsistent_orientation,
  one_sided_surface,
  inside_out_part,
  inward_open_part,
  point_ring,
  collinear_ring,
  several_components,
  self_intersection,  ///< found only by add_self_intersections
};
inline constexpr int kDefectKindCount = static_cast<int>(DefectKind::self_intersection) + 1;

enum class Severity {
  info,     ///< nothing is wrong
  warning,  ///< editing works; the effect is worth knowing
  error,    ///< cannot be edited there
};

/// Elements that a defect's list of indices refers to.
enum class Element {
  none,
  vertex,
  face,
  edge,       ///< two vertices for each edge
  component,  ///< one vertex for each component, its smallest
};

/// A kind of defect in words for the user.
struct DefectInfo {
  std::string_view key;        ///< for reports: "unwelded_seam"
  std::string_view name;       ///< plural: "unwelded seam edges"
  std::string_view meaning;    ///< what it is and what it does to an edit
  std::string_view next_step;  ///< what to do about it; empty if nothing needs doing
  Severity severity = Severity::info;
  Element element = Element::none;
  bool fixable = false;  ///< whether `fix` repairs all of them
};

const DefectInfo& describe(DefectKind kind);

/// Default limit on the places that a defect lists.
inline constexpr std::size_t kMaxListed = 8;

/// One kind of defect and its places. `describe(kind)` explains it.
struct Defect {
  DefectKind kind = DefectKind::no_faces;
  std::size_t count = 0;     ///< number of elements
  std::vector<Index> first;  ///< the first elements, ascending; an edge is two numbers
};

/// The result of `check`. Defects are in the order of DefectKind, each kind at most once.
struct CheckReport {
  std::vector<Defect> defects;
  MeshStatistics statistics;

  /// Returns the defect of this kind, or null if there is none.
  const Defect* find(DefectKind kind) const;
  /// Returns whether any defect is a warning or an error.
  bool has_problems() const;
  /// Returns whether `fix` would repair anything.
  bool is_fixable() const;
};

/// Examines `mesh`. Each defect lists its first `most_listed` places. Positions are compared
/// exactly. A face counts as having no area, and a ring as lying on a line, below 1e-12 of its
/// squared size. Near-linear in the size of the mesh. Accepts any mesh with valid vertex indices.
CheckReport check(const Mesh& mesh, std::size_t most_listed = kMaxListed);

/// Adds the faces that intersect or touch others to the report on `mesh`. `check` omits them
/// because they take several times as long. Throws what `self_intersections` throws.
void add_self_intersections(const Mesh& mesh, CheckReport& report);

}  // namespace lapwing
