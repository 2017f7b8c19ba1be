#pragma once

#include <cstddef>
#include <vector>

#include "lapwing/doctor/defects.h"
#include "lapwing/doctor/statistics.h"
#include "lapwing/mesh/mesh.h"

namespace lapwing {

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
