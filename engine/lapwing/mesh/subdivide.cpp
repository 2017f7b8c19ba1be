// Based on: Loop, "Smooth subdivision surfaces based on triangles", 1987, with the rules for
// borders of Hoppe et al., "Piecewise smooth surface reconstruction", 1994.
#include "lapwing/mesh/subdivide.h"

#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"
#include "lapwing/base/limits.h"
#include "lapwing/mesh/edges.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

void require_triangles(const Mesh& mesh) {
  validate_indices(mesh);
  CancelCheck cancel_check;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    cancel_check();
    const std::size_t corners = mesh.face(f).size();
    if (corners == 3) continue;
    throw InputError("face " + std::to_string(f) + " has " + std::to_string(corners) +
                     " corners; only triangles can be subdivided. Triangulate the mesh first");
  }
  require_finite(mesh);
}

// Splits each triangle into four at the midpoints of its edges.
Mesh split(const Mesh& mesh, const Edges& edges) {
  Mesh fine;
  fine.positions = mesh.positions;
  for (const auto& [a, b] : edges.ends) {
    fine.positions.push_back(0.5 * (mesh.positions[a] + mesh.positions[b]));
  }
  const auto count = static_cast<Index>(mesh.vertex_count());
  CancelCheck cancel_check;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    cancel_check();
    const auto t = mesh.face(f);
    const Index corner = mesh.face_starts()[f];
    std::array<Index, 3> middle{};
    for (Index e = 0; e < 3; ++e) {
      const Index edge = edges.edge_of_side[corner + e];
      // A side from a vertex to itself has no edge; its midpoint is that vertex.
      middle[e] = edge == kNoIndex ? t[e] : count + edge;
    }
    const auto& [a, b, c] = middle;
    fine.add_face(std::array{t[0], a, c});
    fine.add_face(std::array{a, t[1], b});
    fine.add_face(std::array{c, b, t[2]});
    fine.add_face(middle);
  }
  return fine;
}

// Loop's weight of each neighbour of a vertex.
double share_of_neighbour(std::size_t valence) {
  const auto n = static_cast<double>(valence);
  const double c = 0.375 + 0.25 * std::cos(2.0 * std::numbers::pi / n);
  return (0.625 - c * c) / n;
}

// Sums over the edges at one vertex.
struct Surroundings {
  Vector3d sum = Vector3d::Zero();  ///< over all neighbours
  std::size_t valence = 0;
  Vector3d crease_sum = Vector3d::Zero();  ///< over crease edges only
  std::size_t creases = 0;

  void add(const Vector3d& neighbour, bool crease) {
    sum += neighbour;
    ++valence;
    if (!crease) return;
    crease_sum += neighbour;
    ++creases;
  }
};

bool is_crease(const Edges& edges, std::size_t e) {
  return edges.sides.size(e) != 2;
}

Vector3d smoothed(const Vector3d& v, const Surroundings& around) {
  if (around.creases == 2) return 0.75 * v + 0.125 * around.crease_sum;
  if (around.creases != 0 || around.valence == 0) return v;
  const double share = share_of_neighbour(around.valence);
  return v + share * (around.sum - static_cast<double>(around.valence) * v);
}

// 3/8 of each end and 1/8 of each corner across.
Vector3d edge_point(const Mesh& mesh, const Edges& edges, std::size_t e) {
  const auto& [a, b] = edges.ends[e];
  Vector3d point = 0.375 * (mesh.positions[a] + mesh.positions[b]);
  for (const Index side : edges.sides[e]) {
    const Index across = edges.next_corner[edges.next_corner[side]];
    point += 0.125 * mesh.positions[mesh.face_vertices()[across]];
  }
  return point;
}

}  // namespace

void require_subdividable(const Mesh& mesh, int times) {
  require_at_most(kMostTriangles, static_cast<double>(mesh.face_count()) * std::pow(4.0, times),
                  "subdividing would make", "subdivide fewer times, or only a part of the mesh");
}

Mesh subdivide(const Mesh& mesh) {
  require_triangles(mesh);
  require_subdividable(mesh, 1);
  return split(mesh, build_edges(mesh));
}

Mesh loop_subdivide(const Mesh& mesh) {
  require_triangles(mesh);
  require_subdividable(mesh, 1);
  const Edges edges = build_edges(mesh);
  Mesh fine = split(mesh, edges);
  std::vector<Surroundings> around(mesh.vertex_count());
  for (std::size_t e = 0; e < edges.count(); ++e) {
    const auto& [a, b] = edges.ends[e];
    around[a].add(mesh.positions[b], is_crease(edges, e));
    around[b].add(mesh.positions[a], is_crease(edges, e));
    if (!is_crease(edges, e)) {
      fine.positions[mesh.vertex_count() + e] = edge_point(mesh, edges, e);
    }
  }
  CancelCheck cancel_check;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    cancel_check();
    fine.positions[v] = smoothed(mesh.positions[v], around[v]);
  }
  return fine;
}

}  // namespace lapwing
