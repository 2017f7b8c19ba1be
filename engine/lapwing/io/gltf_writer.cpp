#include "lapwing/io/gltf_writer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <unordered_map>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"
#include "lapwing/base/srgb.h"
#include "lapwing/io/binary_numbers.h"
#include "lapwing/io/gltf_file.h"
#include "lapwing/io/material_transfer.h"
#include "lapwing/io/stored_normals.h"
#include "lapwing/io/uri.h"
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

// glTF requires components of colours in [0, 1]. NaN becomes 1, as in `unit_colors`.
float in_range(float component) {
  return std::isnan(component) ? 1.0F : std::clamp(component, 0.0F, 1.0F);
}

// Lists the normals that the file stores. The normals of the mesh come first, followed by computed
// normals for corners without a normal.
class FileNormals {
 public:
  FileNormals(const Mesh& mesh, double feature_angle_degrees)
      : mesh_(mesh), normals_(mesh.attributes().normals) {
    const MeshAttributes& a = mesh.attributes();
    by_vertex_ = a.corner_normals.empty() && a.normals.size() == mesh.vertex_count();
    const bool is_complete = !a.normals.empty() && (by_vertex_ || !a.corner_normals.empty()) &&
                             std::ranges::count(a.corner_normals, kNoIndex) == 0;
    if (is_complete) return;
    StoredNormals computed = computed_normals(mesh, feature_angle_degrees);
    computed_ = std::move(computed.corner_normals);
    normals_.insert(normals_.end(), computed.normals.begin(), computed.normals.end());
  }

  Index of_corner(std::size_t corner) const {
    const MeshAttributes& a = mesh_.attributes();
    if (!a.normals.empty()) {
      if (by_vertex_) return mesh_.face_vertices()[corner];
      if (!a.corner_normals.empty() && a.corner_normals[corner] != kNoIndex) {
        return a.corner_normals[corner];
      }
    }
    return static_cast<Index>(a.normals.size()) + computed_[corner];
  }

  const Vector3d& operator[](Index number) const { return normals_[number]; }

 private:
  const Mesh& mesh_;
  std::vector<Vector3d> normals_;
  std::vector<Index> computed_;  // per corner: index of its computed normal
  bool by_vertex_ = false;
};

// The vertices and triangles of one material.
class Primitive {
 public:
  Primitive(const Mesh& mesh, const FileNormals& normals, const Eigen::Affine3d& to_local)
      : mesh_(mesh), file_normals_(normals), to_local_(to_local) {
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
    require_float(local, corner.vertex, MeshFormat::gltf);
    for (const double x : local) append_float(positions_, x);
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
    Vector3d normal = (normal_to_local_ * file_normals_[corner.normal]).stableNormalized();
    if (!normal.allFinite() || normal.squaredNorm() < 0.5) normal = Vector3d::UnitZ();
    for (const double x : normal) append_float(normals_, x);
    if (has_uvs_) {
      const bool has_uv = corner.uv != kNoIndex && is_finite_float(a.uvs[corner.uv]);
      const Eigen::Vector2d uv = has_uv ? a.uvs[corner.uv] : Eigen::Vector2d(0.0, 1.0);
      append_float(uvs_, uv.x());
      append_float(uvs_, 1.0 - uv.y());  // in glTF v runs downwards
    }
    if (has_colors_) {
      const Eigen::Vector4f& color = a.vertex_colors[corner.vertex];
      for (int c = 0; c < 3; ++c) append_float(colors_, double{linear_of_srgb(in_range(color[c]))});
      append_float(colors_, double{in_range(color[3])});
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
  const FileNormals& file_normals_;
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

// Returns the JSON of one primitive per material, separated by commas.
std::string primitives_of(const Mesh& mesh, std::span<const Index> faces,
                          const FileNormals& normals, const Eigen::Affine3d& to_local,
                          GltfAppender& appender) {
  const MeshAttributes& a = mesh.attributes();
  const bool is_mirrored = to_local.linear().determinant() < 0.0;
  std::map<Index, Primitive> primitives;  // by material; kNoIndex (none) comes last
  const auto value_at = [](const std::vector<Index>& list, std::size_t k) {
    return list.empty() ? kNoIndex : list[k];
  };
  std::vector<Triangle> triangles;
  CancelCheck cancel_check;
  for (const Index f : faces) {
    cancel_check();
    Primitive& primitive =
        primitives.try_emplace(value_at(a.face_materials, f), mesh, normals, to_local)
            .first->second;
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
        corners[k] = {v, value_at(a.corner_uvs, corner), normals.of_corner(corner)};
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
      json += R"(,"material":)" + std::to_string(material);
    }
    json += '}';
  }
  return json;
}

}  // namespace

std::vector<std::string> add_primitives(const Mesh& mesh, std::span<const std::vector<Index>> parts,
                                        const Eigen::Affine3d& to_local, GltfAppender& appender,
                                        double feature_angle_degrees) {
  const FileNormals normals(mesh, feature_angle_degrees);
  std::vector<std::string> primitives;
  for (const std::vector<Index>& faces : parts) {
    primitives.push_back(primitives_of(mesh, faces, normals, to_local, appender));
  }
  return primitives;
}

namespace {

// Texture coordinates that are not finite are replaced, because glTF cannot hold them.
void report_non_finite_uvs(const Mesh& mesh, MeshFormat format, WriteReport& report) {
  const MeshAttributes& a = mesh.attributes();
  std::optional<Index> first;
  std::size_t count = 0;
  for (std::size_t c = 0; c < a.corner_uvs.size(); ++c) {
    if (a.corner_uvs[c] == kNoIndex || is_finite_float(a.uvs[a.corner_uvs[c]])) continue;
    if (!first) first = mesh.face_vertices()[c];
    ++count;
  }
  if (!first) return;
  report_loss(
      report, format,
      "texture coordinates that are not finite, the first at vertex " + std::to_string(*first),
      count);
}

void report_losses(const Mesh& mesh, MeshFormat format, const Vector3d& origin,
                   WriteReport& report) {
  const MeshAttributes& a = mesh.attributes();
  report_uneditable(report, format, a);
  report_rounding(report, format, mesh, origin);
  report_triangulation(report, format, mesh);
  report_non_finite_uvs(mesh, format, report);
  report_loss(report, format, "face colours", a.face_colors.size());
  report_loss(report, format, "comments", a.comments.size());
  report_extras(report, format, a);
}

// Returns the translation of the nodes. It is 0 if rounding to 32-bit floats is harmless. Otherwise
// its coordinates are integer multiples of a power of two near the mesh's size. They thus need few
// digits.
Vector3d origin_of(const Mesh& mesh) {
  if (rounding_of(mesh, Vector3d::Zero()).mean_edges <= kHarmlessRounding) return Vector3d::Zero();
  const Bounds bounds = bounds_of(mesh.positions);
  const double step = std::exp2(std::ceil(std::log2(bounds.diagonal())));
  return step * (bounds.center() / step).array().round().matrix();
}

// Writes a node with a mesh for the faces of each group, and for the faces without a group.
class GltfNodes {
 public:
  GltfNodes(const Mesh& mesh, const std::string& name) {
    const MeshAttributes& a = mesh.attributes();
    parts_.resize(a.groups.size() + 1);
    names_ = a.groups;
    names_.push_back(name);
    for (Index f = 0; f < mesh.face_count(); ++f) {
      const Index group = a.face_groups.empty() ? kNoIndex : a.face_groups[f];
      parts_[std::min<std::size_t>(group, a.groups.size())].push_back(f);
    }
  }

  // Returns "scene", "scenes", "nodes" and "meshes" as JSON, or "" if there are no faces.
  std::string write(const Mesh& mesh, const Vector3d& origin, GltfAppender& appender,
                    double feature_angle_degrees) const {
    const Eigen::Affine3d to_local(Eigen::Translation3d(-origin));
    const std::vector<std::string> primitives =
        add_primitives(mesh, parts_, to_local, appender, feature_angle_degrees);
    std::string roots;
    std::string nodes;
    std::string meshes;
    std::size_t count = 0;
    for (std::size_t k = 0; k < primitives.size(); ++k) {
      if (primitives[k].empty()) continue;
      const std::string comma = count > 0 ? "," : "";
      const std::string name = R"("name":)" + quoted_json(names_[k]);
      roots += comma + std::to_string(count);
      nodes +=
          comma + R"({"mesh":)" + std::to_string(count) + "," + name + translation(origin) + "}";
      meshes += comma + "{" + name + R"(,"primitives":[)" + primitives[k] + "]}";
      ++count;
    }
    if (count == 0) return {};
    return R"(,"scene":0,"scenes":[{"nodes":[)" + roots + R"(]}],"nodes":[)" + nodes +
           R"(],"meshes":[)" + meshes + "]";
  }

 private:
  static std::string translation(const Vector3d& origin) {
    if (origin.isZero()) return {};
    std::string json = R"(,"translation":[)";
    for (const double x : origin) {
      if (json.back() != '[') json += ',';
      append_number(json, x);
    }
    return json + "]";
  }

  std::vector<std::vector<Index>> parts_;
  std::vector<std::string> names_;
};

}  // namespace

std::vector<FileContent> write_gltf(const Mesh& mesh, const std::filesystem::path& target,
                                    const MaterialTransfer& materials, double feature_angle_degrees,
                                    WriteReport& report) {
  const MeshFormat format = format_of(target);
  const Vector3d origin = origin_of(mesh);
  report_losses(mesh, format, origin, report);
  const std::string frame = R"({"bufferViews":[],"accessors":[]})";
  const JsonText frame_text(frame, target.string());
  GltfAppender appender(frame_text, 0);
  const std::string name = target.stem().string();
  const std::string nodes =
      GltfNodes(mesh, name).write(mesh, origin, appender, feature_angle_degrees);
  GltfMaterials surfaces = gltf_materials(materials, target, appender, report);

  const bool has_data = !appender.data().empty();
  std::string json = R"({"asset":{"version":"2.0","generator":"Lapwing"})" + nodes;
  if (has_data) {
    json += R"(,"buffers":[{"byteLength":)" + std::to_string(appender.data().size());
    if (format == MeshFormat::gltf) json += R"(,"uri":")" + uri_of_path(name + ".bin") + '"';
    json += "}]";
  }
  if (!surfaces.json.empty()) json += "," + surfaces.json;
  TextEdits edits;
  appender.finish(edits);
  json += has_data ? "," + edits.applied_to(frame).substr(1) : "}";

  std::vector<FileContent> files{{target, json}};
  if (format == MeshFormat::glb) {
    files.front().bytes =
        glb_of(json, has_data ? std::optional(appender.data()) : std::nullopt, {});
  } else if (has_data) {
    files.push_back({target.parent_path() / (name + ".bin"), appender.data()});
  }
  std::ranges::move(surfaces.files, std::back_inserter(files));
  return files;
}

}  // namespace lapwing
