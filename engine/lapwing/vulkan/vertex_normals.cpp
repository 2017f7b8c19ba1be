#include "lapwing/vulkan/vertex_normals.h"

#include <cstdint>
#include <utility>

#include "lapwing/vulkan/host_frame.h"

namespace lapwing {
namespace {

using Format = gpu::TexelBuffer::Format;

// A triangle around vertex i as the edge opposite to i, from corner to corner in its orientation.
using Edge = std::pair<Index, Index>;

Edge opposite_edge(const Triangle& t, Index i) {
  const std::size_t corner = t[0] == i ? 0 : t[1] == i ? 1 : 2;
  return {t[(corner + 1) % 3], t[(corner + 2) % 3]};
}

// Position of an edge, not before `from`, that begins at `corner`; edges.size() if there is none.
std::size_t find_edge_from(std::span<const Edge> edges, std::size_t from, Index corner) {
  for (std::size_t e = from; e < edges.size(); ++e) {
    if (edges[e].first == corner) return e;
  }
  return edges.size();
}

// Position of an edge at which no other one ends: where an open fan begins.
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

// Sorts `edges` into chains by swapping and appends their corners.
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

Adjacency build_fans(std::span<const Triangle> triangles, const Adjacency& vertex_triangles) {
  Adjacency fans;
  fans.starts.reserve(vertex_triangles.starts.size());
  fans.values.reserve(vertex_triangles.values.size() + vertex_triangles.row_count());
  std::vector<Edge> edges;
  for (Index i = 0; i < vertex_triangles.row_count(); ++i) {
    edges.clear();
    for (const Index t : vertex_triangles[i]) edges.push_back(opposite_edge(triangles[t], i));
    append_fans(edges, fans.values);
    fans.starts.push_back(static_cast<Index>(fans.values.size()));
  }
  return fans;
}

VertexNormals::VertexNormals(VulkanState& state, const Topology& topology)
    : VertexNormals(state, build_fans(topology.triangles, topology.vertex_triangles)) {}

VertexNormals::VertexNormals(VulkanState& state, const Adjacency& fans)
    : state_(state),
      fan_starts_(*state.context, "fan starts", Format::uint, fans.starts.size()),
      fan_corners_(*state.context, "fan corners", Format::uint, fans.values.size()) {
  state.transfer.upload(fan_starts_.buffer(), std::span<const Index>(fans.starts));
  state.transfer.upload(fan_corners_.buffer(), std::span<const Index>(fans.values));
}

gpu::TexelBuffer VertexNormals::upload_list(std::span<const Index> which) const {
  gpu::TexelBuffer list(*state_.context, "vertices with new normals", Format::uint, which.size());
  state_.transfer.upload(list.buffer(), which);
  return list;
}

void VertexNormals::record(gpu::Recorder& recorder, const gpu::TexelBuffer& which,
                           const gpu::TexelBuffer& positions, const gpu::Buffer& normals) const {
  const auto count = static_cast<std::uint32_t>(which.buffer().bytes() / sizeof(Index));
  recorder.dispatch(state_.vertex_normals, count,
                    {which, fan_starts_, fan_corners_, positions, normals}, count);
}

void VertexNormals::run_on_host(const gpu::TexelBuffer& which, const gpu::TexelBuffer& positions,
                                const gpu::Buffer& normals) const {
  normals_on_host(
      which.buffer().mapped_as<Index>(),
      {fan_starts_.buffer().mapped_as<Index>(), fan_corners_.buffer().mapped_as<Index>()},
      positions.buffer().mapped_as<Vec4>(), normals.mapped_as<Vec4>());
}

}  // namespace lapwing
