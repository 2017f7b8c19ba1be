#include "lapwing/mesh/topology.h"

#include <algorithm>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/counted.h"
#include "lapwing/base/errors.h"

namespace lapwing {
namespace {

// Turns counts per row, shifted by one, into row starts.
void accumulate_starts(std::vector<Index>& starts) {
  for (std::size_t i = 1; i < starts.size(); ++i) starts[i] += starts[i - 1];
}

}  // namespace

Adjacency triangles_around_vertices(std::size_t vertex_count, std::span<const Triangle> triangles) {
  Adjacency around;
  around.starts.assign(vertex_count + 1, 0);
  for (const Triangle& t : triangles) {
    for (const Index v : t) ++around.starts[v + 1];
  }
  accumulate_starts(around.starts);
  around.values.resize(around.starts.back());
  std::vector<Index> next(around.starts.begin(), around.starts.end() - 1);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (const Index v : triangles[t]) around.values[next[v]++] = static_cast<Index>(t);
  }
  return around;
}

Adjacency rings_by_triangles(const Adjacency& vertex_triangles,
                             std::span<const Triangle> triangles) {
  Adjacency rings;
  const std::size_t n = vertex_triangles.row_count();
  rings.starts.reserve(n + 1);
  rings.values.reserve(triangles.size() * 3 + n);
  std::vector<Index> ring;
  CancelCheck cancel_check;
  for (std::size_t i = 0; i < n; ++i) {
    cancel_check();
    ring.clear();
    for (const Index t : vertex_triangles[i]) {
      for (const Index v : triangles[t]) {
        if (v != i) ring.push_back(v);
      }
    }
    std::sort(ring.begin(), ring.end());
    ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
    rings.values.insert(rings.values.end(), ring.begin(), ring.end());
    rings.starts.push_back(static_cast<Index>(rings.values.size()));
  }
  return rings;
}

Topology build_topology(const Mesh& mesh) {
  validate_indices(mesh);
  Topology topology;
  const std::size_t faces = mesh.face_count();
  topology.triangles.reserve(mesh.face_vertices().size());
  topology.triangle_faces.reserve(faces);
  std::vector<Triangle> cut;
  CancelCheck cancel_check;
  for (std::size_t f = 0; f < faces; ++f) {
    cancel_check();
    cut.clear();
    triangulate_polygon(mesh.face(f), mesh.positions, cut);
    for (const Triangle& t : cut) {
      if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
      topology.triangles.push_back(t);
      topology.triangle_faces.push_back(static_cast<Index>(f));
    }
  }
  topology.vertex_triangles = triangles_around_vertices(mesh.vertex_count(), topology.triangles);
  topology.rings = rings_by_triangles(topology.vertex_triangles, topology.triangles);
  return topology;
}

Components connected_components(const Adjacency& rings) {
  Components components;
  components.of_vertex.assign(rings.row_count(), kNoIndex);
  std::vector<Index> stack;
  CancelCheck cancel_check;
  for (std::size_t seed = 0; seed < rings.row_count(); ++seed) {
    if (components.of_vertex[seed] != kNoIndex) continue;
    const auto id = static_cast<Index>(components.count++);
    components.of_vertex[seed] = id;
    stack.assign(1, static_cast<Index>(seed));
    while (!stack.empty()) {
      cancel_check();
      const Index v = stack.back();
      stack.pop_back();
      for (const Index w : rings[v]) {
        if (components.of_vertex[w] != kNoIndex) continue;
        components.of_vertex[w] = id;
        stack.push_back(w);
      }
    }
  }
  return components;
}

std::vector<Index> inverse_index(std::span<const Index> list, std::size_t count) {
  std::vector<Index> places(count, kNoIndex);
  for (std::size_t k = 0; k < list.size(); ++k) {
    if (list[k] != kNoIndex) places[list[k]] = static_cast<Index>(k);
  }
  return places;
}

Adjacency inverse_lists(std::span<const Index> list, std::size_t count) {
  Adjacency places;
  places.starts.assign(count + 1, 0);
  for (const Index entry : list) {
    if (entry != kNoIndex) ++places.starts[entry + 1];
  }
  accumulate_starts(places.starts);
  places.values.resize(places.starts.back());
  std::vector<Index> next(places.starts.begin(), places.starts.end() - 1);
  for (std::size_t k = 0; k < list.size(); ++k) {
    if (list[k] != kNoIndex) places.values[next[list[k]]++] = static_cast<Index>(k);
  }
  return places;
}

NumberedTriangles numbered(std::span<const Triangle> triangles) {
  Index end = 0;
  for (const Triangle& t : triangles) end = std::max(end, std::ranges::max(t) + 1);
  std::vector<Index> own(end, kNoIndex);
  for (const Triangle& t : triangles) {
    for (const Index v : t) own[v] = 0;
  }
  NumberedTriangles result;
  for (Index v = 0; v < end; ++v) {
    if (own[v] == kNoIndex) continue;
    own[v] = static_cast<Index>(result.vertices.size());
    result.vertices.push_back(v);
  }
  result.triangles.reserve(triangles.size());
  for (const auto& [a, b, c] : triangles) result.triangles.push_back({own[a], own[b], own[c]});
  return result;
}

std::vector<Index> with_ring_neighbours(std::span<const Index> vertices, const Adjacency& rings) {
  std::vector<char> listed(rings.row_count(), 0);
  for (const Index v : vertices) {
    listed[v] = 1;
    for (const Index w : rings[v]) listed[w] = 1;
  }
  std::vector<Index> list;
  for (Index v = 0; v < listed.size(); ++v) {
    if (listed[v] != 0) list.push_back(v);
  }
  return list;
}

std::string why_no_surface(const Mesh& mesh) {
  const auto is_finite = [&](Index v) { return mesh.positions[v].allFinite(); };
  for (const Triangle& triangle : mesh.topology().triangles) {
    if (std::ranges::all_of(triangle, is_finite)) return {};
  }
  if (mesh.face_count() > 0) return "none of its faces has three different, finite vertices";
  return "it has " + counted(mesh.vertex_count(), "vertices") + " and no faces";
}

void require_surface(const Mesh& mesh, const std::string& where) {
  const std::string why = why_no_surface(mesh);
  if (why.empty()) return;
  throw InputError(where + ": the mesh has no surface to edit: " + why +
                   "; export it with its faces, or reconstruct the surface of the points first");
}

Positions surface_positions(std::span<const Eigen::Vector3d> positions, const Topology& topology) {
  if (topology.triangles.empty()) return {positions.begin(), positions.end()};
  Positions used;
  used.reserve(positions.size());
  for (std::size_t v = 0; v < positions.size(); ++v) {
    if (topology.vertex_triangles.size(v) > 0) used.push_back(positions[v]);
  }
  return used;
}

double mean_edge_length(const Adjacency& rings, std::span<const Eigen::Vector3d> positions) {
  double sum = 0.0;
  for (std::size_t i = 0; i < rings.row_count(); ++i) {
    for (const Index j : rings[i]) sum += (positions[i] - positions[j]).norm();
  }
  return rings.values.empty() ? 0.0 : sum / static_cast<double>(rings.values.size());
}

}  // namespace lapwing
