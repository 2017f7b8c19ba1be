#include "lapwing/vulkan/vertex_normals.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "lapwing/shaders/vertex_normals.h"
#include "lapwing/vulkan/host_frame.h"

namespace lapwing {
namespace {

// A triangle around vertex i, represented by the edge opposite to i in the triangle's orientation.
using Edge = std::pair<Index, Index>;

Edge opposite_edge(const Triangle& t, Index i) {
  const std::size_t corner = t[0] == i ? 0 : t[1] == i ? 1 : 2;
  return {t[(corner + 1) % 3], t[(corner + 2) % 3]};
}

// Returns the index, at least `from`, of an edge that begins at `corner`, or edges.size() if there
// is none.
std::size_t find_edge_from(std::span<const Edge> edges, std::size_t from, Index corner) {
  for (std::size_t e = from; e < edges.size(); ++e) {
    if (edges[e].first == corner) return e;
  }
  return edges.size();
}

// Returns the index, at least `from`, of an edge that begins an open fan (no other edge ends at its
// start), or `from` if there is none.
std::size_t find_open_start(std::span<const Edge> edges, std::size_t from) {
  for (std::size_t e = from; e < edges.size(); ++e) {
    bool continued = false;
    for (std::size_t other = from; other < edges.size(); ++other) {
      continued = continued || edges[other].second == edges[e].first;
    }
    if (!continued) return e;
  }
  return from;
}

// A triangle around a vertex. `normal` is the index in SplitNormals of the normal at this corner of
// the triangle. `edge` is the edge opposite this corner.
struct Corner {
  Index normal;
  Edge edge;
};

// Sorts `edges` in place into chains, and appends the corners of the chains to `corners`.
void append_fans(std::span<Edge> edges, std::vector<Index>& corners) {
  for (std::size_t done = 0; done < edges.size();) {
    std::swap(edges[done], edges[find_open_start(edges, done)]);
    corners.push_back(edges[done].first | kFanBegins);
    for (;;) {
      const Index last = edges[done++].second;
      corners.push_back(last);
      const std::size_t next = find_edge_from(edges, done, last);
      if (next == edges.size()) break;
      std::swap(edges[done], edges[next]);
    }
  }
}

}  // namespace

Adjacency build_fans(std::span<const Triangle> triangles, const Adjacency& vertex_triangles,
                     const SplitNormals& split) {
  Adjacency fans;
  fans.starts.reserve(vertex_triangles.starts.size());
  fans.values.reserve(vertex_triangles.values.size() + vertex_triangles.row_count());
  std::vector<Corner> corners;
  std::vector<Edge> edges;
  for (Index i = 0; i < vertex_triangles.row_count(); ++i) {
    corners.clear();
    for (const Index t : vertex_triangles[i]) {
      const auto k =
          static_cast<std::size_t>(std::ranges::find(triangles[t], i) - triangles[t].begin());
      corners.push_back({split.of_corner[3 * std::size_t{t} + k], opposite_edge(triangles[t], i)});
    }
    std::ranges::stable_sort(corners, {}, &Corner::normal);
    for (auto first = corners.begin(); first != corners.end();) {
      const Index normal = first->normal;
      if (normal != i) fans.values.push_back(normal | kNormalBegins);
      edges.clear();
      for (; first != corners.end() && first->normal == normal; ++first) {
        edges.push_back(first->edge);
      }
      append_fans(edges, fans.values);
    }
    fans.starts.push_back(static_cast<Index>(fans.values.size()));
  }
  return fans;
}

VertexNormals::VertexNormals(gpu::Context& context, gpu::Transfer& transfer,
                             const Topology& topology, const SplitNormals& split)
    : VertexNormals(context, transfer,
                    build_fans(topology.triangles, topology.vertex_triangles, split)) {}

VertexNormals::VertexNormals(gpu::Context& context, gpu::Transfer& transfer, const Adjacency& fans)
    : kernel_(context, "vertex_normals", shaders::vertex_normals(), sizeof(std::uint32_t)),
      fan_starts_(context, "fan starts", fans.starts.size() * sizeof(Index)),
      fan_corners_(context, "fan corners", fans.values.size() * sizeof(Index)) {
  transfer.upload(fan_starts_, fans.starts);
  transfer.upload(fan_corners_, fans.values);
}

void VertexNormals::record(gpu::Recorder& recorder, const gpu::Buffer& which,
                           const gpu::Buffer& positions, const gpu::Buffer& normals) const {
  const auto count = static_cast<std::uint32_t>(which.bytes() / sizeof(Index));
  recorder.dispatch(kernel_, count, {which, fan_starts_, fan_corners_, positions, normals}, count);
}

void VertexNormals::run_on_host(std::span<const Index> which, const gpu::Buffer& positions,
                                const gpu::Buffer& normals) const {
  normals_on_host(which, {fan_starts_.mapped_as<Index>(), fan_corners_.mapped_as<Index>()},
                  positions.mapped_as<Vec4>(), normals.mapped_as<Vec4>());
}

}  // namespace lapwing
