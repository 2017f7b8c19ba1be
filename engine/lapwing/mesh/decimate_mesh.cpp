#include "lapwing/mesh/decimate_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "lapwing/base/errors.h"
#include "lapwing/mesh/compact.h"
#include "lapwing/mesh/decimate.h"
#include "lapwing/mesh/seams.h"
#include "lapwing/mesh/topology.h"

namespace lapwing {
namespace {

// Returns the attributes that must be the same at all corners of a vertex before the vertex may be
// merged.
std::array<Index, 3> kind_of_corner(const MeshAttributes& a, Index corner) {
  const Index face = corner / 3;
  return {a.corner_uvs.empty() ? 0 : a.corner_uvs[corner],
          a.face_materials.empty() ? 0 : a.face_materials[face],
          a.face_groups.empty() ? 0 : a.face_groups[face]};
}

std::vector<Index> merge_groups(const Mesh& mesh, const std::vector<Triangle>& triangles) {
  std::vector<Index> groups(mesh.vertex_count(), 0);
  const MeshAttributes& a = mesh.attributes();
  std::vector<Index> first_corner(mesh.vertex_count(), kNoIndex);
  for (Index corner = 0; corner < 3 * triangles.size(); ++corner) {
    const Index v = triangles[corner / 3][corner % 3];
    Index& first = first_corner[v];
    if (first == kNoIndex) first = corner;
    if (kind_of_corner(a, corner) != kind_of_corner(a, first)) groups[v] = kKeptGroup;
  }
  const JoinedSurface joined = joined_surface(mesh);
  for (const Index v : joined.followers) groups[v] = groups[joined.leaders[v]] = kKeptGroup;
  return groups;
}

// Returns the corner of the original triangles from which a corner of a new triangle copies its
// attributes. Of the triangles at its vertex, this is the one with the most vertices that were
// merged into the new triangle.
Index corner_source(const Triangle& triangle, std::size_t k, const Decimated& decimated,
                    const std::vector<Triangle>& originals, const Adjacency& around) {
  const Index vertex = decimated.kept[triangle[k]];
  Index best = kNoIndex;
  std::ptrdiff_t most = -1;
  for (const Index t : around[vertex]) {
    const std::ptrdiff_t common = std::ranges::count_if(originals[t], [&](Index v) {
      return std::ranges::find(triangle, decimated.owners[v]) != triangle.end();
    });
    if (common <= most) continue;
    most = common;
    const auto at = std::ranges::find(originals[t], vertex) - originals[t].begin();
    best = 3 * t + static_cast<Index>(at);
  }
  return best;
}

}  // namespace

DecimatedMesh decimate(const Mesh& mesh, const DecimateRequest& request, const Progress& progress) {
  const ProgressScope scope(progress);
  report_progress(progress, "decimate", 0.0);
  if (!(request.share > 0.0) || request.share > 1.0) {
    throw InputError(request.where + ": the share of vertices must be above 0 and at most 1, not " +
                     std::to_string(request.share));
  }
  require_surface(mesh, request.where);
  require_finite(mesh);
  Mesh original = mesh;
  triangulate_faces(original);
  const Topology& topology = original.topology();
  const std::vector<Triangle>& originals = topology.triangles;
  std::size_t vertices = 0;
  for (std::size_t v = 0; v < topology.vertex_count(); ++v) {
    if (topology.vertex_triangles.size(v) > 0) ++vertices;
  }
  const auto count =
      static_cast<std::size_t>(std::ceil(request.share * static_cast<double>(vertices)));
  const Decimated decimated =
      decimate(original.positions, originals, merge_groups(original, originals), count);
  FaceSources sources;
  for (const Triangle& triangle : decimated.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      sources.corners.push_back(
          corner_source(triangle, k, decimated, originals, topology.vertex_triangles));
    }
    sources.faces.push_back(sources.corners[sources.corners.size() - 3] / 3);
    sources.starts.push_back(static_cast<Index>(sources.corners.size()));
  }
  DecimatedMesh result{original, decimated.kept};
  replace_faces(result.mesh, sources);
  replace_vertices(result.mesh, decimated.kept);
  Index corner = 0;
  for (Index& v : result.mesh.edit_faces().vertices) {
    v = decimated.triangles[corner / 3][corner % 3];
    ++corner;
  }
  drop_normals(result.mesh);
  drop_unused_attributes(result.mesh);
  return result;
}

}  // namespace lapwing
