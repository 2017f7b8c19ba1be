#pragma once

#include <cstddef>
#include <vector>

#include "lapwing/doctor/defects.h"
#include "lapwing/doctor/statistics.h"
#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// A defect lists at most this many of its places, unless more are asked for.
inline constexpr std::size_t kMaxListed = 8;

/// One kind of defect and where it is. `describe(kind)` says what it means.
struct Defect {
  DefectKind kind = DefectKind::no_faces;
  std::size_t count = 0;     ///< elements concerned
  std::vector<Index> first;  ///< the first of them, ascending; an edge is two numbers
};

/// What the mesh doctor found. Defects are in the order of DefectKind, each kind at most once.
struct CheckReport {
  std::vector<Defect> defects;
  MeshStatistics statistics;

  /// The defect of this kind, or null when there is none.
  const Defect* find(DefectKind kind) const;
  /// Whether any defect is a warning or an error.
  bool has_problems() const;
  /// Whether `fix` would repair anything.
  bool is_fixable() const;
};

/// Examines `mesh`. Each defect lists its first `most_listed` places. Positions are compared
/// exactly; a face has zero area, and a ring lies on one line, below 1e-12 of the square of its
/// size. Near-linear in the size of the mesh. Accepts any mesh whose faces name vertices that it
/// has.
CheckReport check(const Mesh& mesh, std::size_t most_listed = kMaxListed);

/// Adds to the report on `mesh` the faces that cut through or touch others, which `check` leaves
/// out because it takes several times as long. Throws what self_intersections does.
void add_self_intersections(const Mesh& mesh, CheckReport& report);

}  // namespace lapwing
