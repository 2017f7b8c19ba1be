#pragma once

#include <string_view>

namespace lapwing {

/// What can be wrong with a mesh, or worth knowing before it is edited, in the order of the report.
enum class DefectKind {
  kNoFaces,
  kNonFiniteVertex,
  kDegenerateFace,
  kRepeatedFace,
  kZeroAreaFace,
  kLooseVertex,
  kDuplicateVertex,
  kUnweldedSeam,
  kNonManifoldEdge,
  kBowTieVertex,
  kInconsistentOrientation,
  kOneSidedSurface,
  kPointRing,
  kCollinearRing,
  kSeveralComponents,
};
inline constexpr int kDefectKindCount = static_cast<int>(DefectKind::kSeveralComponents) + 1;

enum class Severity {
  kInfo,     ///< nothing is wrong
  kWarning,  ///< legal to edit; the effect is worth knowing
  kError,    ///< cannot be edited there
};

/// What a defect's list of indices names.
enum class Element {
  kNone,
  kVertex,
  kFace,
  kEdge,       ///< two vertices for each edge
  kComponent,  ///< one vertex for each component, its smallest
};

/// What a kind of defect is, in words for the user.
struct DefectInfo {
  std::string_view key;        ///< for reports: "unwelded_seam"
  std::string_view name;       ///< plural: "unwelded seam edges"
  std::string_view meaning;    ///< what it is and what it does to an edit
  std::string_view next_step;  ///< what to do about it; empty if nothing needs doing
  Severity severity = Severity::kInfo;
  Element element = Element::kNone;
  bool fixable = false;  ///< `fix` leaves none of it
};

const DefectInfo& describe(DefectKind kind);

}  // namespace lapwing
