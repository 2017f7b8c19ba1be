#include "lapwing/fill/hole_attributes.h"

#include <algorithm>
#include <numeric>

#include <Eigen/Geometry>

#include "lapwing/base/cancellation.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

std::size_t nearest(std::span<const Vector3d> rim, const Vector3d& point) {
  std::size_t best = 0;
  for (std::size_t k = 1; k < rim.size(); ++k) {
    if ((rim[k] - point).squaredNorm() < (rim[best] - point).squaredNorm()) best = k;
  }
  return best;
}

template <typename Value>
void append_copy(std::vector<Value>& values, std::size_t source, std::size_t components = 1) {
  for (std::size_t k = 0; k < components && !values.empty(); ++k) {
    values.push_back(Value(values[source * components + k]));
  }
}

void append_extras(std::vector<ExtraAttribute>& extras, std::size_t source) {
  for (ExtraAttribute& extra : extras) {
    append_copy(extra.values, source, static_cast<std::size_t>(extra.components));
  }
}

// Returns a face at each vertex, or kNoIndex.
std::vector<Index> face_at_vertices(const Mesh& mesh) {
  std::vector<Index> faces(mesh.vertex_count(), kNoIndex);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    for (const Index v : mesh.face(f)) faces[v] = std::min(faces[v], f);
  }
  return faces;
}

// Appends patches to a mesh.
class PatchAppender {
 public:
  explicit PatchAppender(Mesh& mesh) : mesh_(mesh), face_at_(face_at_vertices(mesh)) {}

  void append(const Hole& hole, const HolePatch& patch) {
    const auto first_new = static_cast<Index>(mesh_.vertex_count());
    const std::vector<Index> vertices = patch_vertices(hole, patch, first_new);
    append_vertices(hole, patch);
    for (const auto& [a, b, c] : patch.triangles) {
      mesh_.add_face(std::array{vertices[a], vertices[b], vertices[c]});
    }
    append_face_attributes(hole, patch);
    append_normals(patch);
  }

 private:
  void append_vertices(const Hole& hole, const HolePatch& patch) {
    const std::size_t n = hole.rim.size();
    const auto rim = std::span(patch.points).first(n);
    MeshAttributes& a = mesh_.edit_attributes();
    CancelCheck cancel_check;
    for (std::size_t k = n; k < patch.points.size(); ++k) {
      cancel_check();
      mesh_.positions.push_back(patch.points[k]);
      append_extras(a.vertex_extras, hole.rim[nearest(rim, patch.points[k])]);
      if (a.vertex_colors.empty()) continue;
      const std::vector<double> weights = rim_weights(rim, patch.points[k]);
      Eigen::Vector4f color = Eigen::Vector4f::Zero();
      for (std::size_t i = 0; i < n; ++i) {
        color += static_cast<float>(weights[i]) * a.vertex_colors[hole.rim[i]];
      }
      a.vertex_colors.push_back(color);
    }
  }

  void append_face_attributes(const Hole& hole, const HolePatch& patch) {
    const auto rim = std::span(patch.points).first(hole.rim.size());
    MeshAttributes& a = mesh_.edit_attributes();
    for (const auto& [i, j, k] : patch.triangles) {
      const Vector3d center = (patch.points[i] + patch.points[j] + patch.points[k]) / 3.0;
      const Index source = face_at_[hole.rim[nearest(rim, center)]];
      append_copy(a.face_colors, source);
      append_copy(a.face_materials, source);
      append_copy(a.face_groups, source);
      append_extras(a.face_extras, source);
      if (!a.corner_uvs.empty()) a.corner_uvs.insert(a.corner_uvs.end(), 3, kNoIndex);
    }
  }

  // Gives new vertices, or the corners of the patch, the area-weighted normals of the patch.
  void append_normals(const HolePatch& patch) {
    MeshAttributes& a = mesh_.edit_attributes();
    if (!a.has_vertex_normals && a.corner_normals.empty()) return;
    std::vector<Vector3d> normals(patch.points.size(), Vector3d::Zero());
    for (const Triangle& t : patch.triangles) {
      const Vector3d area =
          (patch.points[t[1]] - patch.points[t[0]]).cross(patch.points[t[2]] - patch.points[t[0]]);
      for (const Index point : t) normals[point] += area;
    }
    for (Vector3d& normal : normals) normal.normalize();
    if (a.has_vertex_normals) {
      const std::size_t added = mesh_.vertex_count() - a.normals.size();
      a.normals.insert(a.normals.end(), normals.end() - static_cast<std::ptrdiff_t>(added),
                       normals.end());
      return;
    }
    const auto first = static_cast<Index>(a.normals.size());
    a.normals.insert(a.normals.end(), normals.begin(), normals.end());
    for (const Triangle& t : patch.triangles) {
      for (const Index point : t) a.corner_normals.push_back(first + point);
    }
  }

  Mesh& mesh_;
  std::vector<Index> face_at_;  // per old vertex
};

}  // namespace

std::vector<double> rim_weights(std::span<const Vector3d> rim, const Vector3d& point) {
  std::vector<double> weights(rim.size());
  for (std::size_t k = 0; k < rim.size(); ++k) {
    const double squared = (rim[k] - point).squaredNorm();
    if (squared == 0.0) {
      std::ranges::fill(weights, 0.0);
      weights[k] = 1.0;
      return weights;
    }
    weights[k] = 1.0 / squared;
  }
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  for (double& weight : weights) weight /= sum;
  return weights;
}

std::vector<Index> patch_vertices(const Hole& hole, const HolePatch& patch, Index first_new) {
  std::vector<Index> vertices = hole.rim;
  vertices.resize(patch.points.size());
  std::iota(vertices.begin() + static_cast<std::ptrdiff_t>(hole.rim.size()), vertices.end(),
            first_new);
  return vertices;
}

void append_patches(Mesh& mesh, std::span<const Hole> holes, std::span<const HolePatch> patches) {
  PatchAppender appender(mesh);
  for (std::size_t k = 0; k < holes.size(); ++k) appender.append(holes[k], patches[k]);
  mesh.source.reset();
}

}  // namespace lapwing
