#pragma once

#include <string_view>

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

}  // namespace lapwing
