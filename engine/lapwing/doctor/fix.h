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

/// A repair in words for reports.
struct RepairInfo {
  std::string_view key;   ///< "welded_vertices"
  std::string_view text;  ///< what was done, as text after the count
};
const RepairInfo& describe(RepairKind kind);

/// The number of repairs of one kind.
struct Repair {
  RepairKind kind = RepairKind::removed_non_finite_vertices;
  std::size_t count = 0;
};

/// The result of `fix`. Repairs are in the order of RepairKind, each kind at most once, counts
/// above 0.
struct FixReport {
  std::vector<Repair> repairs;
  std::vector<Index> vertex_sources;  ///< the old number of each vertex; the old order, copies last

  bool changed() const { return !repairs.empty(); }
  /// Returns the number of repairs of this kind; 0 if there were none.
  std::size_t count(RepairKind kind) const;
};

/// Repairs defects that have one sensible repair, so that `check` finds no fixable defect
/// afterwards and a second call does nothing:
///  - removes vertices that are not finite, with their faces, and vertices without a face;
///  - replaces each face that repeats a vertex by faces that do not, and removes it if there are
///    none (mend_faces);
///  - removes faces that have the same vertices as an earlier face;
///  - welds boundary edges at exactly the same place (find_seams), keeping the lower vertex;
///  - gives each fan of a bow-tie vertex its own vertex;
///  - flips faces of inconsistent sheets, so that neighbours have the same orientation
///    (analyze_orientation);
///  - flips closed sheets that are inside out, together with the closed sheets inside them.
/// Attributes stay with their vertices, faces and corners, so UVs and materials survive; stored
/// normals are not recomputed. Positions do not change. Any repair resets `mesh.source`.
/// Non-manifold edges, zero-area faces and one-sided surfaces stay. Near-linear. Throws InputError,
/// and leaves the mesh unchanged, if an index or attribute list is invalid, or if a mesh with
/// vertices would be left without faces.
FixReport fix(Mesh& mesh);

}  // namespace lapwing
