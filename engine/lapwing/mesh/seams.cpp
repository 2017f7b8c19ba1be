#include "lapwing/mesh/seams.h"

#include <algorithm>
#include <array>
#include <utility>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/union_find.h"
#include "lapwing/mesh/welder.h"

namespace lapwing {

Adjacency find_seams(const Mesh& mesh, const Edges& edges,
                     const std::vector<Index>& first_at_position) {
  using Place = std::pair<Index, Index>;
  std::vector<std::pair<Place, Index>> boundary;
  for (std::size_t e = 0; e < edges.count(); ++e) {
    if (!edges.is_boundary(e)) continue;
    const auto [a, b] = edges.ends[e];
    if (!mesh.positions[a].allFinite() || !mesh.positions[b].allFinite()) continue;
    const auto [low, high] = std::minmax(first_at_position[a], first_at_position[b]);
    if (low != high) boundary.push_back({{low, high}, static_cast<Index>(e)});
  }
  std::ranges::sort(boundary);
  Adjacency seams;
  for (std::size_t i = 0; i < boundary.size();) {
    std::size_t end = i + 1;
    while (end < boundary.size() && boundary[end].first == boundary[i].first) ++end;
    if (end - i > 1) {
      for (; i < end; ++i) seams.values.push_back(boundary[i].second);
      seams.starts.push_back(static_cast<Index>(seams.values.size()));
    }
    i = end;
  }
  return seams;
}

std::vector<Index> joined_at_seams(const Adjacency& seams, const Edges& edges,
                                   const std::vector<Index>& first_at_position) {
  UnionFind joined(first_at_position.size());
  for (std::size_t s = 0; s < seams.row_count(); ++s) {
    const auto [a, b] = edges.ends[seams[s][0]];
    for (const Index edge : seams[s].subspan(1)) {
      auto [c, d] = edges.ends[edge];
      if (first_at_position[c] != first_at_position[a]) std::swap(c, d);
      joined.unite(a, c);
      joined.unite(b, d);
    }
  }
  std::vector<Index> leaders(first_at_position.size());
  for (Index v = 0; v < leaders.size(); ++v) leaders[v] = joined.find(v);
  return leaders;
}

namespace {

// Returns one entry per face: 1 if it has a triangle.
std::vector<unsigned char> proper_faces(const Mesh& mesh) {
  std::vector<unsigned char> proper(mesh.face_count(), 0);
  for (const Index face : mesh.topology().triangle_faces) proper[face] = 1;
  return proper;
}

Mesh led_mesh(const Mesh& mesh, const std::vector<Index>& leaders) {
  Mesh led;
  led.positions = mesh.positions;
  Faces& faces = led.edit_faces();
  faces = mesh.faces();
  for (Index& v : faces.vertices) v = leaders[v];
  return led;
}

}  // namespace

bool JoinedSurface::is_closed_at(std::span<const Eigen::Vector3d> positions) const {
  return std::ranges::all_of(followers,
                             [&](Index v) { return positions[v] == positions[leaders[v]]; });
}

void JoinedSurface::close(std::span<Eigen::Vector3d> positions) const {
  for (const Index v : followers) {
    // Equal positions stay, so that 0 does not replace -0.
    if (positions[v] != positions[leaders[v]]) positions[v] = positions[leaders[v]];
  }
}

JoinedSurface joined_surface(const Mesh& mesh) {
  const std::vector<unsigned char> proper = proper_faces(mesh);
  JoinedSurface joined;
  const std::vector<Index> first_at_position = first_at_same_position(mesh.positions);
  const auto is_first = [&, v = Index{0}](Index first) mutable { return first == v++; };
  if (std::ranges::all_of(first_at_position, is_first)) return joined;
  const Edges edges = build_edges(mesh, proper);
  const Adjacency seams = find_seams(mesh, edges, first_at_position);
  if (seams.values.empty()) return joined;
  joined.leaders = joined_at_seams(seams, edges, first_at_position);
  for (const Index e : seams.values) {
    const auto [a, b] = edges.ends[e];
    joined.edges.push_back({joined.leaders[a], joined.leaders[b]});
  }
  CancelCheck cancel_check;
  for (Index v = 0; v < joined.leaders.size(); ++v) {
    cancel_check();
    if (joined.is_follower(v)) joined.followers.push_back(v);
  }
  joined.surface = led_mesh(mesh, joined.leaders);
  return joined;
}

}  // namespace lapwing
