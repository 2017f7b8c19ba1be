#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// Kinds of repairs, in the order of the report.
enum class RepairKind {
  removed_non_finite_vertices,
  removed_non_finite_faces,
  mended_faces,
  removed_degenerate_faces,
  removed_repeated_faces,
  welded_vertices,
  welded_unlike_vertices,
  removed_loose_vertices,
  split_bow_ties,
  flipped_faces,
  turned_parts,
};
inline constexpr int kRepairKindCount = static_cast<int>(RepairKind::turned_parts) + 1;

/// Texts about a kind of repair.
struct RepairInfo {
  std::string_view key;   ///< "welded_vertices"
  std::string_view text;  ///< description that follows the count
};
const RepairInfo& describe(RepairKind kind);

/// The number of repairs of one kind.
struct Repair {
  RepairKind kind = RepairKind::removed_non_finite_vertices;
  std::size_t count = 0;
};

/// The result of `fix`. Repairs are in the order of RepairKind, each kind at most once, with
/// positive counts.
struct FixReport {
  std::vector<Repair> repairs;
  std::vector<Index> vertex_sources;  ///< old index of each vertex; in the old order, copies last

  bool changed() const { return !repairs.empty(); }
  /// Returns the number of repairs of this kind; 0 if there were none.
  std::size_t count(RepairKind kind) const;
};

/// Repairs defects that have only one sensible repair. Afterwards, `check` finds no fixable defect,
/// and a second call does nothing. The function
///  - removes non-finite vertices with their faces, and vertices without a face;
///  - replaces each face that repeats a vertex by proper faces, or removes it (mend_faces);
///  - removes faces that have the same vertices as an earlier face;
///  - welds coincident boundary edges (find_seams), and keeps the vertices of lower index;
///  - creates a separate vertex for each fan of a bow-tie vertex;
///  - flips faces of inconsistent sheets, so that neighbours have the same orientation
///    (analyze_orientation);
///  - flips closed sheets that are inside out, together with the closed sheets inside them.
/// Attributes of the remaining vertices, faces and corners are preserved; stored normals are not
/// recomputed. Positions do not change. Any repair resets `mesh.source`. Non-manifold edges,
/// zero-area faces and one-sided surfaces are not repaired. Near-linear. Throws InputError, and
/// leaves the mesh unchanged, if an index or attribute list is invalid, or if a mesh with vertices
/// would have no faces afterwards.
FixReport fix(Mesh& mesh);

}  // namespace lapwing
