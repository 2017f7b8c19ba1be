#include "lapwing/mesh/compact.h"

#include <algorithm>
#include <string>
#include <utility>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"
#include "lapwing/mesh/topology.h"

namespace lapwing {
namespace {

void require_length(const std::string& name, std::size_t length, std::size_t wanted) {
  if (length == 0 || length == wanted) return;
  throw InputError("the mesh has " + std::to_string(length) + " values of '" + name +
                   "', but needs " + std::to_string(wanted) + "; clear the list or complete it");
}

void require_extras(const std::vector<ExtraAttribute>& extras, std::size_t elements) {
  for (const ExtraAttribute& extra : extras) {
    require_length(extra.name, extra.values.size(),
                   elements * static_cast<std::size_t>(extra.components));
  }
}

// Sets element i to the old element `sources[i]`. An empty list stays empty.
template <typename Value>
void gather(std::vector<Value>& values, std::span<const Index> sources,
            std::size_t components = 1) {
  if (values.empty()) return;
  std::vector<Value> gathered;
  gathered.reserve(sources.size() * components);
  for (const Index source : sources) {
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(source * components);
    gathered.insert(gathered.end(), first, first + static_cast<std::ptrdiff_t>(components));
  }
  values = std::move(gathered);
}

void gather(std::vector<ExtraAttribute>& extras, std::span<const Index> sources) {
  for (ExtraAttribute& extra : extras) {
    gather(extra.values, sources, static_cast<std::size_t>(extra.components));
  }
}

// Keeps only the values that `numbers` refers to, and renumbers `numbers`.
template <typename Value>
void drop_unnamed(std::vector<Value>& values, std::vector<Index>& numbers) {
  std::vector<Index> renumbered(values.size(), kNoIndex);
  for (const Index n : numbers) {
    if (n < renumbered.size()) renumbered[n] = 0;
  }
  std::vector<Index> sources;
  for (std::size_t n = 0; n < values.size(); ++n) {
    if (renumbered[n] == kNoIndex) continue;
    renumbered[n] = static_cast<Index>(sources.size());
    sources.push_back(static_cast<Index>(n));
  }
  gather(values, sources);
  for (Index& n : numbers) n = n < renumbered.size() ? renumbered[n] : kNoIndex;
}

}  // namespace

void validate_attributes(const Mesh& mesh) {
  const MeshAttributes& a = mesh.attributes();
  require_length("corner UVs", a.corner_uvs.size(), mesh.face_vertices().size());
  require_length("corner normals", a.corner_normals.size(), mesh.face_vertices().size());
  require_length("face colours", a.face_colors.size(), mesh.face_count());
  require_length("face materials", a.face_materials.size(), mesh.face_count());
  require_length("face groups", a.face_groups.size(), mesh.face_count());
  require_extras(a.face_extras, mesh.face_count());
  require_length("vertex colours", a.vertex_colors.size(), mesh.vertex_count());
  if (a.has_vertex_normals) {
    require_length("vertex normals", a.normals.size(), mesh.vertex_count());
  }
  require_extras(a.vertex_extras, mesh.vertex_count());
}

void replace_faces(Mesh& mesh, const FaceSources& sources) {
  validate_attributes(mesh);
  Faces& faces = mesh.edit_faces();
  faces.starts = sources.starts;
  gather(faces.vertices, sources.corners);
  MeshAttributes& a = mesh.edit_attributes();
  gather(a.corner_uvs, sources.corners);
  gather(a.corner_normals, sources.corners);
  gather(a.face_colors, sources.faces);
  gather(a.face_materials, sources.faces);
  gather(a.face_groups, sources.faces);
  gather(a.face_extras, sources.faces);
  mesh.source.reset();
}

void keep_faces(Mesh& mesh, const KeepMask& keep) {
  FaceSources sources;
  CancelCheck cancel_check;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    cancel_check();
    if (!keep[f]) continue;
    sources.faces.push_back(static_cast<Index>(f));
    for (Index c = mesh.face_starts()[f]; c < mesh.face_starts()[f + 1]; ++c) {
      sources.corners.push_back(c);
    }
    sources.starts.push_back(static_cast<Index>(sources.corners.size()));
  }
  replace_faces(mesh, sources);
}

void replace_vertices(Mesh& mesh, std::span<const Index> sources) {
  validate_attributes(mesh);
  gather(mesh.positions, sources);
  MeshAttributes& a = mesh.edit_attributes();
  gather(a.vertex_colors, sources);
  if (a.has_vertex_normals) gather(a.normals, sources);
  gather(a.vertex_extras, sources);
  mesh.source.reset();
}

std::vector<Index> keep_vertices(Mesh& mesh, const KeepMask& keep) {
  validate_attributes(mesh);
  KeepMask keep_face(mesh.face_count());
  CancelCheck cancel_check;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    cancel_check();
    keep_face[f] = std::ranges::all_of(mesh.face(f), [&](Index v) { return keep[v] != 0; });
  }
  keep_faces(mesh, keep_face);
  std::vector<Index> sources;
  std::vector<Index> renumbered(mesh.vertex_count(), kNoIndex);
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    if (!keep[v]) continue;
    renumbered[v] = static_cast<Index>(sources.size());
    sources.push_back(static_cast<Index>(v));
  }
  for (Index& v : mesh.edit_faces().vertices) v = renumbered[v];
  replace_vertices(mesh, sources);
  return sources;
}

void triangulate_faces(Mesh& mesh) {
  const std::shared_ptr<const Topology> topology = mesh.shared_topology();
  if (topology->triangles.size() == mesh.face_count() &&
      mesh.face_vertices().size() == 3 * mesh.face_count()) {
    return;
  }
  FaceSources sources;
  CancelCheck cancel_check;
  for (std::size_t t = 0; t < topology->triangles.size(); ++t) {
    cancel_check();
    const Index face = topology->triangle_faces[t];
    const auto polygon = mesh.face(face);
    for (const Index v : topology->triangles[t]) {
      const auto at = std::ranges::find(polygon, v) - polygon.begin();
      sources.corners.push_back(mesh.face_starts()[face] + static_cast<Index>(at));
    }
    sources.faces.push_back(face);
    sources.starts.push_back(static_cast<Index>(sources.corners.size()));
  }
  replace_faces(mesh, sources);
}

void drop_normals(Mesh& mesh) {
  validate_attributes(mesh);
  MeshAttributes& a = mesh.edit_attributes();
  a.normals.clear();
  a.corner_normals.clear();
  a.has_vertex_normals = false;
  mesh.source.reset();
}

void drop_unused_attributes(Mesh& mesh) {
  validate_attributes(mesh);
  MeshAttributes& a = mesh.edit_attributes();
  drop_unnamed(a.uvs, a.corner_uvs);
  if (!a.has_vertex_normals) drop_unnamed(a.normals, a.corner_normals);
  drop_unnamed(a.materials, a.face_materials);
  drop_unnamed(a.groups, a.face_groups);
  mesh.source.reset();
}

}  // namespace lapwing
