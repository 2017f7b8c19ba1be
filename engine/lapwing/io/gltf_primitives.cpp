#include "lapwing/io/gltf_primitives.h"

#include <algorithm>
#include <array>
#include <map>
#include <unordered_map>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"
#include "lapwing/base/srgb.h"
#include "lapwing/io/binary_numbers.h"
#include "lapwing/io/writing.h"
#include "lapwing/mesh/topology.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

// Corners with equal keys share a vertex of the file.
struct CornerKey {
  Index vertex;
  Index uv;
  Index normal;
  bool operator==(const CornerKey&) const = default;
};

struct HashOfCorner {
  std::size_t operator()(const CornerKey& key) const {
    std::uint64_t hash = key.vertex * 0x9E3779B97F4A7C15U;
    hash = (hash ^ key.uv) * 0xC2B2AE3D27D4EB4FU;
    hash = (hash ^ key.normal) * 0x165667B19E3779F9U;
    return hash ^ (hash >> 32U);
  }
};

void append_float(std::string& out, double value) {
  append_binary(out, value, Scalar::float32, Encoding::little_endian);
}

// Returns the area-weighted mean normal of the faces at each vertex.
std::vector<Vector3d> mean_normals(const Mesh& mesh) {
  std::vector<Vector3d> normals(mesh.vertex_count(), Vector3d::Zero());
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    Vector3d sum = Vector3d::Zero();
    for (std::size_t k = 2; k < face.size(); ++k) {
      sum += (mesh.positions[face[k - 1]] - mesh.positions[face[0]])
                 .cross(mesh.positions[face[k]] - mesh.positions[face[0]]);
    }
    for (const Index v : face) normals[v] += sum;
  }
  for (Vector3d& normal : normals) {
    normal = normal.stableNormalized();
    if (!normal.allFinite() || normal.squaredNorm() < 0.5) normal = Vector3d::UnitZ();
  }
  return normals;
}

// The vertices and triangles of one material.
class Primitive {
 public:
  Primitive(const Mesh& mesh, const std::vector<Vector3d>& means, const Eigen::Affine3d& to_local)
      : mesh_(mesh), means_(means), to_local_(to_local) {
    normal_to_local_ = to_local.linear().inverse().transpose();
    const MeshAttributes& a = mesh.attributes();
    has_uvs_ = !a.uvs.empty();
    has_colors_ = !a.vertex_colors.empty();
  }

  void add_triangle(const std::array<CornerKey, 3>& corners) {
    for (const CornerKey& corner : corners) indices_.push_back(number_of(corner));
  }

  std::string finish(GltfAppender& appender) const {
    using Target = GltfAppender::Target;
    std::string json = R"({"attributes":{"POSITION":)";
    json += std::to_string(appender.add_numbers(positions_, Scalar::float32, "VEC3", count_,
                                                Target::vertices, bounds()));
    json += R"(,"NORMAL":)" + std::to_string(appender.add_numbers(normals_, Scalar::float32, "VEC3",
                                                                  count_, Target::vertices));
    if (has_uvs_) {
      json += R"(,"TEXCOORD_0":)" + std::to_string(appender.add_numbers(
                                        uvs_, Scalar::float32, "VEC2", count_, Target::vertices));
    }
    if (has_colors_) {
      json += R"(,"COLOR_0":)" + std::to_string(appender.add_numbers(
                                     colors_, Scalar::float32, "VEC4", count_, Target::vertices));
    }
    constexpr std::size_t kMostShort = 65534;
    const Scalar type = count_ <= kMostShort ? Scalar::uint16 : Scalar::uint32;
    std::string indices;
    for (const Index index : indices_) {
      append_binary(indices, static_cast<double>(index), type, Encoding::little_endian);
    }
    return json + R"(},"indices":)" +
           std::to_string(
               appender.add_numbers(indices, type, "SCALAR", indices_.size(), Target::indices));
  }

 private:
  Index number_of(const CornerKey& corner) {
    const auto [found, is_new] = numbers_.try_emplace(corner, static_cast<Index>(count_));
    if (!is_new) return found->second;
    ++count_;
    const Vector3d local = to_local_ * mesh_.positions[corner.vertex];
    for (const double x : local) {
      if (!(std::abs(x) <= double{std::numeric_limits<float>::max()})) {
        throw InputError("vertex " + std::to_string(corner.vertex) +
                         " has a coordinate that is not finite in the 32-bit floats of glTF; "
                         "repair or scale the mesh, or write another format");
      }
      append_float(positions_, x);
    }
    for (std::size_t c = 0; c < 3; ++c) {
      const auto axis = static_cast<Eigen::Index>(c);
      const double x = static_cast<double>(static_cast<float>(local[axis]));
      least_[c] = count_ == 1 ? x : std::min(least_[c], x);
      most_[c] = count_ == 1 ? x : std::max(most_[c], x);
    }
    add_attributes(corner);
    return found->second;
  }

  void add_attributes(const CornerKey& corner) {
    const MeshAttributes& a = mesh_.attributes();
    Vector3d normal = corner.normal == kNoIndex ? means_[corner.vertex] : a.normals[corner.normal];
    normal = (normal_to_local_ * normal).stableNormalized();
    if (!normal.allFinite() || normal.squaredNorm() < 0.5) normal = Vector3d::UnitZ();
    for (const double x : normal) append_float(normals_, x);
    if (has_uvs_) {
      const Eigen::Vector2d uv =
          corner.uv == kNoIndex ? Eigen::Vector2d(0.0, 1.0) : a.uvs[corner.uv];
      append_float(uvs_, uv.x());
      append_float(uvs_, 1.0 - uv.y());  // in glTF v runs downwards
    }
    if (has_colors_) {
      const Eigen::Vector4f& color = a.vertex_colors[corner.vertex];
      for (int c = 0; c < 3; ++c) append_float(colors_, double{linear_of_srgb(color[c])});
      append_float(colors_, double{color[3]});
    }
  }

  std::string bounds() const {
    std::string json = R"(,"min":[)";
    for (std::size_t c = 0; c < 3; ++c) {
      json += c > 0 ? "," : "";
      append_number(json, static_cast<float>(least_[c]));
    }
    json += R"(],"max":[)";
    for (std::size_t c = 0; c < 3; ++c) {
      json += c > 0 ? "," : "";
      append_number(json, static_cast<float>(most_[c]));
    }
    return json + "]";
  }

  const Mesh& mesh_;
  const std::vector<Vector3d>& means_;
  const Eigen::Affine3d& to_local_;
  Eigen::Matrix3d normal_to_local_;
  bool has_uvs_ = false;
  bool has_colors_ = false;
  std::size_t count_ = 0;
  std::unordered_map<CornerKey, Index, HashOfCorner> numbers_;
  std::vector<Index> indices_;
  std::string positions_;
  std::string normals_;
  std::string uvs_;
  std::string colors_;
  std::array<double, 3> least_{};
  std::array<double, 3> most_{};
};

}  // namespace

std::string add_primitives(const Mesh& mesh, std::span<const Index> faces,
                           const Eigen::Affine3d& to_local, std::size_t first_material,
                           GltfAppender& appender) {
  const MeshAttributes& a = mesh.attributes();
  const std::vector<Vector3d> means = mean_normals(mesh);
  const bool is_mirrored = to_local.linear().determinant() < 0.0;
  std::map<Index, Primitive> primitives;  // by material; kNoIndex (none) comes last
  const auto value_at = [](const std::vector<Index>& list, std::size_t k) {
    return list.empty() ? kNoIndex : list[k];
  };
  // Only normals per vertex or corner are used.
  const bool has_normals = !a.normals.empty();
  std::vector<Triangle> triangles;
  CancelCheck cancel_check;
  for (const Index f : faces) {
    cancel_check();
    Primitive& primitive =
        primitives.try_emplace(value_at(a.face_materials, f), mesh, means, to_local).first->second;
    triangles.clear();
    const auto face = mesh.face(f);
    triangulate_polygon(face, mesh.positions, triangles);
    for (const Triangle& triangle : triangles) {
      std::array<CornerKey, 3> corners{};
      for (std::size_t k = 0; k < 3; ++k) {
        const Index v = triangle[k];
        const std::size_t corner =
            mesh.face_starts()[f] +
            static_cast<std::size_t>(std::ranges::find(face, v) - face.begin());
        const bool by_vertex = a.corner_normals.empty() && a.normals.size() == mesh.vertex_count();
        const Index normal = !has_normals ? kNoIndex
                             : by_vertex  ? v
                                          : value_at(a.corner_normals, corner);
        corners[k] = {v, value_at(a.corner_uvs, corner), normal};
      }
      if (is_mirrored) std::swap(corners[1], corners[2]);
      primitive.add_triangle(corners);
    }
  }
  std::string json;
  for (const auto& [material, primitive] : primitives) {
    if (!json.empty()) json += ',';
    json += primitive.finish(appender);
    if (material != kNoIndex) {
      json += R"(,"material":)" + std::to_string(first_material + material);
    }
    json += '}';
  }
  return json;
}

}  // namespace lapwing
