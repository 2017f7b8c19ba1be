#include "lapwing/doctor/statistics.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include <Eigen/Geometry>

#include "lapwing/base/cancellation.h"
#include "lapwing/doctor/orientation.h"
#include "lapwing/mesh/edges.h"

namespace lapwing {
namespace {

std::vector<std::size_t> component_sizes(const Topology& topology) {
  const Components components = connected_components(topology.rings);
  std::vector<std::size_t> sizes(components.count, 0);
  for (std::size_t v = 0; v < topology.vertex_count(); ++v) {
    if (topology.rings.size(v) > 0) ++sizes[components.of_vertex[v]];
  }
  std::erase(sizes, 0U);
  std::ranges::sort(sizes, std::greater<>());
  return sizes;
}

long count_used_vertices(const Mesh& mesh, const Fans& fans) {
  std::vector<unsigned char> used(mesh.vertex_count(), 0);
  for (std::size_t c = 0; c < mesh.face_vertices().size(); ++c) {
    if (fans.of_corner[c] != kNoIndex) used[mesh.face_vertices()[c]] = 1;
  }
  return static_cast<long>(std::ranges::count(used, 1));
}

long count_used_faces(const Topology& topology) {
  // Triangles are in the order of their faces.
  long count = 0;
  CancelCheck cancel_check;
  for (std::size_t t = 0; t < topology.triangles.size(); ++t) {
    cancel_check();
    if (t == 0 || topology.triangle_faces[t] != topology.triangle_faces[t - 1]) ++count;
  }
  return count;
}

void measure_edges(const Mesh& mesh, const Edges& edges, MeshStatistics& statistics) {
  double shortest = std::numeric_limits<double>::infinity();
  double sum = 0.0;
  std::size_t finite = 0;
  for (std::size_t e = 0; e < edges.count(); ++e) {
    if (edges.is_boundary(e)) ++statistics.boundary_edges;
    const double length =
        (mesh.positions[edges.ends[e][0]] - mesh.positions[edges.ends[e][1]]).norm();
    if (!std::isfinite(length)) continue;
    ++finite;
    sum += length;
    shortest = std::min(shortest, length);
    statistics.max_edge_length = std::max(statistics.max_edge_length, length);
  }
  if (finite == 0) return;
  statistics.min_edge_length = shortest;
  statistics.mean_edge_length = sum / static_cast<double>(finite);
}

double area_of(const Mesh& mesh) {
  double area = 0.0;
  for (const Triangle& t : mesh.topology().triangles) {
    const Eigen::Vector3d& a = mesh.positions[t[0]];
    const double part = 0.5 * (mesh.positions[t[1]] - a).cross(mesh.positions[t[2]] - a).norm();
    if (std::isfinite(part)) area += part;
  }
  return area;
}

bool is_orientable_manifold(const Edges& edges, const Fans& fans, const Orientation& orientation) {
  if (!fans.bow_tie_vertices.empty() || !orientation.one_sided_edges.empty()) return false;
  for (std::size_t e = 0; e < edges.count(); ++e) {
    if (edges.sides.size(e) > 2) return false;
  }
  return edges.count() > 0;
}

}  // namespace

MeshStatistics measure(const Mesh& mesh, const Edges& edges, const Fans& fans,
                       const Orientation& orientation) {
  const Topology& topology = mesh.topology();
  MeshStatistics statistics;
  statistics.vertices = mesh.vertex_count();
  statistics.faces = mesh.face_count();
  statistics.triangles = topology.triangles.size();
  statistics.edges = edges.count();
  measure_edges(mesh, edges, statistics);
  statistics.boundary_loops = count_boundary_loops(edges, fans);
  statistics.component_sizes = component_sizes(topology);
  statistics.euler_characteristic = count_used_vertices(mesh, fans) -
                                    static_cast<long>(edges.count()) + count_used_faces(topology);
  if (is_orientable_manifold(edges, fans, orientation)) {
    // chi = 2 C - 2 g - b over C components with b boundary loops.
    statistics.genus =
        (2 * static_cast<long>(statistics.component_sizes.size()) -
         static_cast<long>(statistics.boundary_loops) - statistics.euler_characteristic) /
        2;
  }
  statistics.bounds = bounds_of(mesh.positions);
  statistics.area = area_of(mesh);
  return statistics;
}

}  // namespace lapwing
