#include "lapwing/mesh/joined_surface.h"

#include <algorithm>

#include "lapwing/base/cancellation.h"
#include "lapwing/mesh/coincident.h"
#include "lapwing/mesh/seams.h"

namespace lapwing {
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
