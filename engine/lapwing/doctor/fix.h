#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// What `fix` can do, in the order of its report.
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
};
inline constexpr int kRepairKindCount = static_cast<int>(RepairKind::flipped_faces) + 1;

/// A repair as reports name it.
struct RepairInfo {
  std::string_view key;   ///< "welded_vertices"
  std::string_view text;  ///< what was done, to follow the count
};
const RepairInfo& describe(RepairKind kind);

/// How often one kind of repair was made.
struct Repair {
  RepairKind kind = RepairKind::removed_non_finite_vertices;
  std::size_t count = 0;
};

/// What `fix` did. Repairs are in the order of RepairKind, each kind at most once, counts above 0.
struct FixReport {
  std::vector<Repair> repairs;
  std::vector<Index> vertex_sources;  ///< the old number of each vertex; the old order, copies last

  bool changed() const { return !repairs.empty(); }
  /// The number of repairs of this kind; 0 if there were none.
  std::size_t count(RepairKind kind) const;
};

/// Repairs what has one sensible repair, so that `check` finds no defect marked fixable afterwards
/// and a second call does nothing:
///  - removes vertices that are not finite, with their faces, and vertices without a face;
///  - cuts faces that repeat a vertex down to their proper parts and removes those without any;
///  - removes faces with the vertices of an earlier one;
///  - welds boundary edges at exactly the same place (find_seams), keeping the lower vertex;
///  - gives each fan of a bow-tie vertex a vertex of its own;
///  - flips faces until neighbours agree, where they do not (analyze_orientation).
/// Attributes go with their vertices, faces and corners, so UVs and materials survive; stored
/// normals are carried, not recomputed. Positions do not change. `mesh.source` is reset when
/// anything was repaired; otherwise the mesh stays as it is. Non-manifold edges, zero-area faces
/// and one-sided surfaces stay. Near-linear. Throws InputError, and leaves the mesh unchanged, when
/// an index or attribute list is invalid or when a mesh that has vertices would be left without
/// faces.
FixReport fix(Mesh& mesh);

}  // namespace lapwing
