#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "lapwing/doctor/holes.h"
#include "lapwing/doctor/statistics.h"
#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// Kinds of defects, and of facts that are useful before an edit, in the order of the report.
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
  hole,
  self_intersection,  ///< found only by add_self_intersections
};
inline constexpr int kDefectKindCount = static_cast<int>(DefectKind::self_intersection) + 1;

enum class Severity {
  info,     ///< not a defect
  warning,  ///< editing works, but the defect has an effect
  error,    ///< the mesh cannot be edited at the defect
};

/// Type of the elements in a defect's list of indices.
enum class Element {
  none,
  vertex,
  face,
  edge,       ///< two vertices per edge
  component,  ///< the smallest vertex of each component
  rim,        ///< the smallest vertex of each rim
};

/// Texts about a kind of defect.
struct DefectInfo {
  std::string_view key;        ///< for reports: "unwelded_seam"
  std::string_view name;       ///< plural: "unwelded seam edges"
  std::string_view meaning;    ///< what the defect is, and its effect on an edit
  std::string_view next_step;  ///< recommended action; may be empty
  Severity severity = Severity::info;
  Element element = Element::none;
  bool fixable = false;  ///< whether `fix` repairs all defects of this kind
};

const DefectInfo& describe(DefectKind kind);

/// Default maximum number of elements that a defect lists.
inline constexpr std::size_t kMaxListed = 8;

/// All defects of one kind. `describe(kind)` explains the kind.
struct Defect {
  DefectKind kind = DefectKind::no_faces;
  std::size_t count = 0;     ///< number of elements
  std::vector<Index> first;  ///< the first elements, ascending; an edge is two entries
};

/// The result of `check`. Defects are in the order of DefectKind, each kind at most once.
struct CheckReport {
  std::vector<Defect> defects;
  MeshStatistics statistics;
  std::vector<Hole> holes;  ///< all boundary loops, including the borders of open sheets

  /// Returns the defect of this kind, or null if there is none.
  const Defect* find(DefectKind kind) const;
  /// Returns whether any defect is a warning or an error.
  bool has_problems() const;
  /// Returns whether `fix` would repair anything.
  bool is_fixable() const;
};

/// Examines `mesh`. Each defect lists at most `most_listed` elements. Positions are compared
/// exactly. The tolerance for zero-area faces and collinear rings is 1e-12 of the squared size.
/// Near-linear in the size of the mesh. Accepts any mesh with valid vertex indices.
CheckReport check(const Mesh& mesh, std::size_t most_listed = kMaxListed);

/// Adds the faces that intersect or touch others to the report about `mesh`. `check` omits them,
/// because they take several times as long. Throws the errors of `self_intersections`.
void add_self_intersections(const Mesh& mesh, CheckReport& report);

}  // namespace lapwing
