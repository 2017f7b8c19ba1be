#include "lapwing/parameterize/uv_mesh.h"

#include <algorithm>
#include <numeric>

#include "lapwing/base/cancellation.h"
#include "lapwing/mesh/compact.h"

namespace lapwing {
namespace {

// The new polygons, and the own number of each of their corners.
class Recut {
 public:
  Recut(const Mesh& mesh, const Patch& patch)
      : mesh_(mesh), topology_(mesh.topology()), patch_(patch) {
    const Topology& topology = mesh.topology();
    std::size_t triangle = 0;
    CancelCheck cancel_check;
    for (Index f = 0; f < mesh.face_count(); ++f) {
      cancel_check();
      const std::size_t first = triangle;
      while (triangle < topology.triangles.size() && topology.triangle_faces[triangle] == f) {
        ++triangle;
      }
      add_face(f, first, triangle);
    }
  }

  FaceSources sources;
  std::vector<Index> own_numbers;

 private:
  // Returns the patch's triangles that lie in a triangle of the mesh.
  std::span<const Triangle> parts(std::size_t triangle) const {
    const auto& all = patch_.triangle_sources;
    const auto [first, last] = std::equal_range(all.begin(), all.end(), triangle);
    return std::span(patch_.triangles)
        .subspan(static_cast<std::size_t>(first - all.begin()),
                 static_cast<std::size_t>(last - first));
  }

  void add_face(Index face, std::size_t first, std::size_t last) {
    bool is_inside = first < last;
    bool is_cut = false;
    for (std::size_t t = first; t < last; ++t) {
      is_inside = is_inside && !parts(t).empty();
      is_cut = is_cut || parts(t).size() > 1;
    }
    if (!is_cut) {
      for (Index c = mesh_.face_starts()[face]; c < mesh_.face_starts()[face + 1]; ++c) {
        add_corner(c, is_inside ? patch_.own_number(mesh_.face_vertices()[c]) : kNoIndex);
      }
      end_face(face);
      return;
    }
    for (std::size_t t = first; t < last; ++t) {
      for (const Triangle& part : parts(t)) {
        for (const Index own : part) add_corner(corner_of(face, mesh_vertex(own)), own);
        end_face(face);
      }
      if (!parts(t).empty()) continue;
      for (const Index v : topology_.triangles[t]) add_corner(corner_of(face, v), kNoIndex);
      end_face(face);
    }
  }

  // Returns the mesh vertex; for a midpoint one of its ends, whose attributes it takes.
  Index mesh_vertex(Index own) const {
    const std::size_t n = patch_.vertices.size();
    return patch_.vertices[own < n ? own : patch_.midpoint_of[own - n][0]];
  }
  Index corner_of(Index face, Index vertex) const {
    const auto polygon = mesh_.face(face);
    const auto at = std::find(polygon.begin(), polygon.end(), vertex) - polygon.begin();
    return mesh_.face_starts()[face] + static_cast<Index>(at);
  }

  void add_corner(Index corner, Index own) {
    sources.corners.push_back(corner);
    own_numbers.push_back(own);
  }
  void end_face(Index face) {
    sources.faces.push_back(face);
    sources.starts.push_back(static_cast<Index>(sources.corners.size()));
  }

  const Mesh& mesh_;
  const Topology& topology_;
  const Patch& patch_;
};

}  // namespace

Mesh with_uvs(const Mesh& mesh, const Patch& patch, std::span<const Eigen::Vector2d> uvs) {
  const Recut recut(mesh, patch);
  Mesh result = mesh;
  replace_faces(result, recut.sources);
  const std::size_t n = patch.vertices.size();
  std::vector<Index> vertices(mesh.vertex_count());
  std::iota(vertices.begin(), vertices.end(), Index{0});
  for (const auto& ends : patch.midpoint_of) vertices.push_back(patch.vertices[ends[0]]);
  replace_vertices(result, vertices);
  for (std::size_t m = 0; m < patch.midpoint_of.size(); ++m) {
    const auto [a, b] = patch.midpoint_of[m];
    result.positions[mesh.vertex_count() + m] =
        0.5 * (mesh.positions[patch.vertices[a]] + mesh.positions[patch.vertices[b]]);
  }
  std::vector<Index>& vertex_of = result.edit_faces().vertices;
  for (std::size_t c = 0; c < recut.own_numbers.size(); ++c) {
    const Index own = recut.own_numbers[c];
    if (own == kNoIndex || own < n) continue;
    vertex_of[c] = static_cast<Index>(mesh.vertex_count() + own - n);
  }
  MeshAttributes& attributes = result.edit_attributes();
  attributes.uvs.assign(uvs.begin(), uvs.end());
  attributes.corner_uvs = recut.own_numbers;
  return result;
}

}  // namespace lapwing
