#include "lapwing/mesh/subdivide_mesh.h"

#include <array>
#include <map>
#include <utility>

#include "lapwing/base/errors.h"
#include "lapwing/mesh/compact.h"
#include "lapwing/mesh/edges.h"
#include "lapwing/mesh/subdivide.h"

namespace lapwing {
namespace {

constexpr std::size_t kChildren = 4;

template <typename Value>
void repeat(std::vector<Value>& values, std::size_t components = 1) {
  std::vector<Value> repeated;
  repeated.reserve(kChildren * values.size());
  for (std::size_t k = 0; k < values.size(); k += components) {
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(k);
    for (std::size_t child = 0; child < kChildren; ++child) {
      repeated.insert(repeated.end(), first, first + static_cast<std::ptrdiff_t>(components));
    }
  }
  values = std::move(repeated);
}

void append_edge_values(MeshAttributes& a, const Edges& edges) {
  for (const auto& [from, to] : edges.ends) {
    if (!a.vertex_colors.empty()) {
      a.vertex_colors.push_back(0.5F * (a.vertex_colors[from] + a.vertex_colors[to]));
    }
    for (ExtraAttribute& extra : a.vertex_extras) {
      const auto width = static_cast<std::size_t>(extra.components);
      for (std::size_t k = 0; k < width && !extra.values.empty(); ++k) {
        extra.values.push_back(double(extra.values[from * width + k]));
      }
    }
  }
}

// Gives the corners of the four children of each triangle texture coordinates, in the order of
// `subdivide`.
void subdivide_uvs(MeshAttributes& a) {
  if (a.corner_uvs.empty()) return;
  std::map<std::pair<Index, Index>, Index> middles;
  const auto middle = [&](Index from, Index to) {
    if (from == kNoIndex || to == kNoIndex) return kNoIndex;
    const auto [at, is_new] =
        middles.try_emplace(std::minmax(from, to), static_cast<Index>(a.uvs.size()));
    if (is_new) a.uvs.emplace_back(0.5 * (a.uvs[from] + a.uvs[to]));
    return at->second;
  };
  std::vector<Index> corners;
  corners.reserve(kChildren * a.corner_uvs.size());
  for (std::size_t c = 0; c < a.corner_uvs.size(); c += 3) {
    const std::array t{a.corner_uvs[c], a.corner_uvs[c + 1], a.corner_uvs[c + 2]};
    const std::array m{middle(t[0], t[1]), middle(t[1], t[2]), middle(t[2], t[0])};
    corners.insert(corners.end(), {t[0], m[0], m[2], m[0], t[1], m[1], m[2], m[1], t[2]});
    corners.insert(corners.end(), m.begin(), m.end());
  }
  a.corner_uvs = std::move(corners);
}

Mesh subdivided_once(const Mesh& mesh, bool smooth) {
  Mesh fine = smooth ? loop_subdivide(mesh) : subdivide(mesh);
  MeshAttributes& a = fine.edit_attributes();
  a = mesh.attributes();
  append_edge_values(a, build_edges(mesh));
  subdivide_uvs(a);
  repeat(a.face_colors);
  repeat(a.face_materials);
  repeat(a.face_groups);
  for (ExtraAttribute& extra : a.face_extras) {
    repeat(extra.values, static_cast<std::size_t>(extra.components));
  }
  return fine;
}

}  // namespace

Mesh subdivide(const Mesh& mesh, const SubdivideRequest& request, const Progress& progress) {
  const ProgressScope scope(progress);
  if (request.times < 1) {
    throw InputError(request.where + ": the number of subdivisions must be at least 1, not " +
                     std::to_string(request.times));
  }
  Mesh fine = mesh;
  triangulate_faces(fine);
  drop_normals(fine);
  require_subdividable(fine, request.times);
  for (int k = 0; k < request.times; ++k) {
    report_progress(progress, "subdivide", static_cast<double>(k) / request.times);
    fine = subdivided_once(fine, request.smooth);
  }
  return fine;
}

}  // namespace lapwing
