#include "lapwing/transplant/cut.h"

#include <algorithm>
#include <utility>

#include "lapwing/base/errors.h"
#include "lapwing/mesh/compact.h"

namespace lapwing {
namespace {

// Returns one entry per polygon of `mesh`: 1 if all its corners are in the region.
KeepMask polygons_inside(const Mesh& mesh, const VertexSet& region, const std::string& where) {
  const std::vector<char> inside = vertex_mask(mesh.vertex_count(), region);
  KeepMask mask(mesh.face_count());
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    mask[f] = std::ranges::all_of(mesh.face(f), [&](Index v) { return inside[v] != 0; });
  }
  if (std::ranges::find(mask, 1) == mask.end()) {
    throw InputError(where + ": no polygon of the mesh has all its corners in the region (" +
                     std::to_string(region.size()) +
                     " vertices), so nothing is cut; choose a larger region");
  }
  return mask;
}

KeepMask vertices_of(const Mesh& mesh, const KeepMask& polygons) {
  KeepMask mask(mesh.vertex_count(), 0);
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    if (polygons[f] == 0) continue;
    for (const Index v : mesh.face(f)) mask[v] = 1;
  }
  return mask;
}

CutPiece piece(const Mesh& mesh, const KeepMask& polygons, const KeepMask& vertices) {
  CutPiece result{mesh, {}};
  keep_faces(result.mesh, polygons);
  result.vertices = keep_vertices(result.mesh, vertices);
  drop_unused_attributes(result.mesh);
  return result;
}

}  // namespace

CutPiece cut_out(const Mesh& mesh, const VertexSet& region, const std::string& where) {
  const KeepMask inside = polygons_inside(mesh, region, where);
  return piece(mesh, inside, vertices_of(mesh, inside));
}

CutPiece cut_away(const Mesh& mesh, const VertexSet& region, const std::string& where) {
  const KeepMask inside = polygons_inside(mesh, region, where);
  if (std::ranges::find(inside, 0) == inside.end()) {
    throw InputError(where +
                     ": the region contains every polygon of the mesh, so nothing remains around "
                     "the hole; choose a smaller region");
  }
  KeepMask outside(inside.size());
  for (std::size_t f = 0; f < inside.size(); ++f) outside[f] = inside[f] == 0;
  // Vertices outside the region remain, even if no polygon uses them.
  KeepMask vertices = vertices_of(mesh, outside);
  const std::vector<char> in_region = vertex_mask(mesh.vertex_count(), region);
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    if (in_region[v] == 0) vertices[v] = 1;
  }
  return piece(mesh, outside, vertices);
}

}  // namespace lapwing
