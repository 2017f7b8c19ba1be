#pragma once

#include <vector>

#include "lapwing/mesh/mesh.h"

namespace lapwing::test {

/// A mesh in which some vertices are duplicated.
struct SplitMesh {
  Mesh mesh;
  std::vector<Index> sources;  ///< original vertex of each vertex
};

/// Returns the mesh with separate vertices for each polygon.
inline SplitMesh soup(const Mesh& mesh) {
  SplitMesh split;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    std::vector<Index> polygon;
    for (const Index v : mesh.face(f)) {
      polygon.push_back(static_cast<Index>(split.sources.size()));
      split.sources.push_back(v);
      split.mesh.positions.push_back(mesh.positions[v]);
    }
    split.mesh.add_face(polygon);
  }
  return split;
}

/// Splits the mesh along the boundary of the polygons for which `is_beyond` is true, as in files
/// with two texture charts. The duplicates of the vertices on this boundary are the last vertices.
template <class IsBeyond>
SplitMesh split_where(const Mesh& mesh, const IsBeyond& is_beyond) {
  SplitMesh split;
  split.mesh.positions = mesh.positions;
  std::vector<char> is_shared(mesh.vertex_count(), 0);
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    for (const Index v : mesh.face(f)) {
      if (!is_beyond(f)) is_shared[v] = 1;
    }
  }
  for (Index v = 0; v < mesh.vertex_count(); ++v) split.sources.push_back(v);
  std::vector<Index> copies(mesh.vertex_count(), kNoIndex);
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    std::vector<Index> polygon(mesh.face(f).begin(), mesh.face(f).end());
    for (Index& v : polygon) {
      if (!is_beyond(f) || !is_shared[v]) continue;
      if (copies[v] == kNoIndex) {
        copies[v] = static_cast<Index>(split.sources.size());
        split.sources.push_back(v);
        split.mesh.positions.push_back(mesh.positions[v]);
      }
      v = copies[v];
    }
    split.mesh.add_face(polygon);
  }
  return split;
}

/// Splits the mesh between the first and the second half of its polygons.
inline SplitMesh halves(const Mesh& mesh) {
  return split_where(mesh, [&](std::size_t f) { return 2 * f >= mesh.face_count(); });
}

}  // namespace lapwing::test
