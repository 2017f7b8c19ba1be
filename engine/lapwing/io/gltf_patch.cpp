#include "lapwing/io/gltf_patch.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <system_error>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "lapwing/base/errors.h"
#include "lapwing/io/gltf_edits.h"
#include "lapwing/io/gltf_instances.h"
#include "lapwing/io/gltf_morph.h"
#include "lapwing/io/gltf_scene.h"
#include "lapwing/io/gltf_splice.h"
#include "lapwing/io/paths.h"
#include "lapwing/io/source_file.h"
#include "lapwing/io/stored_normals.h"
#include "lapwing/io/uri.h"
#include "lapwing/json/json_text.h"

namespace lapwing {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;

// Tangents that differ by less are equal up to rounding.
constexpr double kSameDirection = 1e-6;

// Returns the `tangents` of a record set in world coordinates, after the vertices of `mesh` moved
// from `rest`. The deformation of each triangle at a record maps the old tangent to a new
// direction. The new tangent is the area-weighted mean of these directions, made perpendicular to
// the new normal and normalized. If no triangle defines a direction, the old tangent stays.
// `normals` has one entry for each of MeshAttributes::normals.
std::vector<Vector3d> transport_tangents(const GltfLayout& layout, const GltfRecords& set,
                                         const GltfAccessor& tangents, const Mesh& mesh,
                                         std::span<const Vector3d> rest,
                                         std::span<const Vector3d> normals) {
  const Eigen::Matrix3d to_world = layout.objects[set.object].to_world.linear();
  std::vector<Vector3d> old;
  for (std::size_t k = 0; k < set.count(); ++k) old.push_back(to_world * tangents.vector3(k));
  std::vector<Vector3d> sums(set.count(), Vector3d::Zero());
  const std::vector<Index>& corners = mesh.face_vertices();
  for (std::size_t c = 0; c < corners.size(); ++c) {
    const std::size_t record = layout.record_of_corner[c];
    if (record < set.first_record || record - set.first_record >= set.count()) continue;
    const std::size_t first = c - c % 3;  // faces are triangles
    const Vector3d e = rest[corners[first + 1]] - rest[corners[first]];
    const Vector3d f = rest[corners[first + 2]] - rest[corners[first]];
    const double area = e.cross(f).norm();
    if (!(area > 0.0)) continue;
    // The old tangent as a e + b f, in the triangle's plane.
    const Vector3d t = old[record - set.first_record];
    const Eigen::Matrix2d products{{e.dot(e), e.dot(f)}, {e.dot(f), f.dot(f)}};
    const Eigen::Vector2d ab = products.inverse() * Eigen::Vector2d(e.dot(t), f.dot(t));
    if (!ab.allFinite()) continue;
    const Vector3d& corner = mesh.positions[corners[first]];
    const Vector3d now = ab[0] * (mesh.positions[corners[first + 1]] - corner) +
                         ab[1] * (mesh.positions[corners[first + 2]] - corner);
    sums[record - set.first_record] += area * now.stableNormalized();
  }
  for (std::size_t k = 0; k < set.count(); ++k) {
    const Index normal = layout.normal_of_record[set.first_record + k];
    if (normal != kNoIndex) sums[k] -= normals[normal].dot(sums[k]) * normals[normal];
    const Vector3d tangent = sums[k].stableNormalized();
    if (tangent.allFinite() && tangent.squaredNorm() > 0.5) old[k] = tangent;
  }
  return old;
}

class GltfPatch {
 public:
  GltfPatch(const SourceFile& source, const Mesh& mesh, WriteReport& report)
      : source_(source), layout_(*source.gltf), mesh_(mesh), report_(report), numbers_(layout_) {}

  std::vector<FileContent> run(const fs::path& target) {
    choose_meshes();
    for (const GltfRecords& set : layout_.records) move(set);
    if (numbers_.has_changed()) turn();
    return files_at(target);
  }

  std::vector<FileContent> run_with_new_triangles(const fs::path& target) {
    replace_triangles(layout_, mesh_, numbers_, edits_, report_);
    return files_at(target);
  }

  std::vector<FileContent> run_as_morph_targets(std::span<const MorphTarget> targets,
                                                const fs::path& target) {
    add_morph_targets(layout_, mesh_, targets, numbers_, edits_);
    return files_at(target);
  }

 private:
  // Decides which mesh of the new file stores the positions of each object.
  void choose_meshes() {
    for (const GltfObject& object : layout_.objects) mesh_of_object_.emplace_back(object.mesh);
    for (const MovedInstances& instances : moved_instances(layout_, mesh_)) {
      if (instances.are_alike) {
        store_once(instances);
      } else {
        store_separately(instances);
      }
    }
  }

  void store_once(const MovedInstances& instances) {
    for (const std::size_t object : instances.objects) {
      if (object != instances.moved.front()) mesh_of_object_[object].reset();
    }
    const std::vector<std::string> others = others_showing(layout_, instances.moved);
    if (others.empty()) return;
    report_.notes.push_back(note_of_shared_edit(layout_, instances.moved, others));
  }

  // Objects that did not move keep the shared mesh. If all objects moved, the first one keeps it.
  void store_separately(const MovedInstances& instances) {
    const bool all_moved = others_showing(layout_, instances.moved).empty();
    for (const std::size_t object : instances.moved) {
      if (all_moved && object == instances.moved.front()) continue;
      mesh_of_object_[object] = numbers_.separate(object);
    }
    report_.notes.push_back(note_of_separation(layout_, instances.moved));
  }

  void move(const GltfRecords& set) {
    const std::optional<std::size_t> mesh = mesh_of_object_[set.object];
    if (!mesh) return;
    const Eigen::Affine3d to_local = layout_.objects[set.object].to_world.inverse();
    for (std::size_t k = 0; k < set.count(); ++k) {
      const Index v = layout_.vertex_of_record[set.first_record + k];
      if (are_same(layout_.position(set, k), mesh_.positions[v])) continue;
      const bool stays = to_local.matrix() == Eigen::Matrix4d::Identity();
      const Vector3d local = stays ? mesh_.positions[v] : to_local * mesh_.positions[v];
      numbers_.set(set.positions, "POSITION", *mesh, k, local);
    }
  }

  void turn() {
    const Positions rest = source_positions(source_, mesh_);
    const std::vector<Vector3d>& old_normals = mesh_.attributes().normals;
    const bool has_tangents = std::ranges::any_of(
        layout_.records, [](const GltfRecords& set) { return set.tangents.has_value(); });
    if (old_normals.empty() && !has_tangents) return;
    const StoredNormals updated = updated_normals(mesh_, rest);
    for (const GltfRecords& set : layout_.records) {
      const std::optional<std::size_t> mesh = mesh_of_object_[set.object];
      if (!mesh) continue;
      if (set.normals) turn_normals(set, *set.normals, *mesh, old_normals, updated.normals);
      if (set.tangents) turn_tangents(set, *set.tangents, *mesh, rest, updated.normals);
    }
  }

  void turn_normals(const GltfRecords& set, const GltfAccessor& normals, std::size_t mesh,
                    std::span<const Vector3d> old, std::span<const Vector3d> updated) {
    const Eigen::Matrix3d to_local = layout_.objects[set.object].to_world.linear().transpose();
    for (std::size_t k = 0; k < set.count(); ++k) {
      const Index n = layout_.normal_of_record[set.first_record + k];
      if (!are_same(old[n], updated[n])) {
        numbers_.set(normals, "NORMAL", mesh, k, (to_local * updated[n]).normalized());
      }
    }
  }

  void turn_tangents(const GltfRecords& set, const GltfAccessor& tangents, std::size_t mesh,
                     std::span<const Vector3d> rest, std::span<const Vector3d> normals) {
    const Eigen::Matrix3d to_world = layout_.objects[set.object].to_world.linear();
    const Eigen::Matrix3d to_local = to_world.inverse();
    const auto carried = transport_tangents(layout_, set, tangents, mesh_, rest, normals);
    // Other tangents stay as in the file, even if they are not perpendicular to the normal.
    const auto touched = touched_records(set, rest);
    for (std::size_t k = 0; k < set.count(); ++k) {
      if (!touched[k]) continue;
      const Vector3d local = (to_local * carried[k]).stableNormalized();
      if ((local - tangents.vector3(k)).norm() <= kSameDirection) continue;
      numbers_.set(tangents, "TANGENT", mesh, k, local);
    }
  }

  // Marks the records at triangles with a moved corner.
  std::vector<bool> touched_records(const GltfRecords& set, std::span<const Vector3d> rest) const {
    std::vector<bool> touched(set.count(), false);
    const std::vector<Index>& corners = mesh_.face_vertices();
    for (std::size_t first = 0; first + 2 < corners.size(); first += 3) {
      bool has_moved = false;
      for (std::size_t k = 0; k < 3; ++k) {
        const Index v = corners[first + k];
        has_moved = has_moved || !are_same(rest[v], mesh_.positions[v]);
      }
      for (std::size_t k = 0; has_moved && k < 3; ++k) {
        const std::size_t record = layout_.record_of_corner[first + k];
        if (record >= set.first_record && record - set.first_record < set.count()) {
          touched[record - set.first_record] = true;
        }
      }
    }
    return touched;
  }

  std::vector<FileContent> files_at(const fs::path& target) {
    numbers_.finish(edits_);
    const bool stays = is_same_file(target, source_.path());
    std::vector<FileContent> files(1);
    std::size_t serial = 0;
    const JsonText& text = layout_.file.json();
    const auto list = text.find(text.root(), "buffers");
    const std::vector<JsonPlace> places = list ? text.elements(*list) : std::vector<JsonPlace>();
    for (std::size_t k = 0; k < places.size(); ++k) {
      const GltfBuffer& old = layout_.file.buffers()[k];
      const std::optional<std::string>& changed = numbers_.buffer(k);
      if (old.kind == GltfBuffer::Kind::data_uri && changed) {
        const JsonNode node = layout_.file.root().at("buffers").at(k).at("uri");
        const std::string head = node.string().substr(0, old.data_offset);
        edits_.replace(text.at(places[k], "uri"), quoted_json(head + encode_base64(*changed)));
      }
      if (old.kind != GltfBuffer::Kind::file) continue;
      if (stays) {
        if (changed) files.push_back({old.path, *changed});
        continue;
      }
      std::string name;
      do {
        name = target.stem().string() + (serial > 0 ? "-" + std::to_string(serial) : "") + ".bin";
        ++serial;
      } while (is_read(target.parent_path() / name));
      edits_.replace(text.at(places[k], "uri"), quoted_json(uri_of_path(name)));
      files.push_back({target.parent_path() / name, changed ? *changed : std::string(old.bytes)});
    }
    files[0] = {target, main_file()};
    if (!stays) note_images(target);
    return files;
  }

  // Whether `path` is a buffer file of the source, which must not be overwritten.
  bool is_read(const fs::path& path) const {
    return std::ranges::any_of(layout_.file.buffers(), [&](const GltfBuffer& buffer) {
      return buffer.kind == GltfBuffer::Kind::file && is_same_file(buffer.path, path);
    });
  }

  std::string main_file() {
    if (edits_.is_empty() && !numbers_.has_changed()) return std::string(source_.bytes());
    require_no_compressed_copy(layout_.file.root());
    if (!layout_.file.is_binary()) return edits_.applied_to(layout_.file.json().text());
    // This keeps a chunk that no buffer of the document uses.
    std::optional<std::string_view> chunk = layout_.file.chunk();
    const auto& buffers = layout_.file.buffers();
    if (!buffers.empty() && buffers[0].kind == GltfBuffer::Kind::chunk) {
      if (const auto& changed = numbers_.buffer(0)) chunk = *changed;
    }
    return glb_of(edits_.applied_to(layout_.file.json().text()), chunk,
                  layout_.file.further_chunks()) +
           std::string(layout_.file.tail());
  }

  void note_images(const fs::path& target) {
    const auto images = layout_.file.root().find("images");
    if (!images) return;
    for (const JsonNode& image : images->elements()) {
      const auto uri = image.find("uri");
      if (!uri || !uri->is_string() || uri->string().starts_with("data:")) continue;
      const std::string name = path_of_uri(uri->string());
      std::error_code error;
      if (fs::exists(target.parent_path() / name, error)) continue;
      report_.notes.push_back("image '" + name + "' is not beside " + target.string() +
                              "; copy it there");
    }
  }

  const SourceFile& source_;
  const GltfLayout& layout_;
  const Mesh& mesh_;
  WriteReport& report_;
  GltfNumbers numbers_;
  TextEdits edits_;
  // The mesh that stores the positions of each object. Empty if another object that shows the same
  // mesh provides them.
  std::vector<std::optional<std::size_t>> mesh_of_object_;
};

}  // namespace

std::vector<FileContent> patch_gltf(const SourceFile& source, const Mesh& mesh,
                                    const fs::path& target,
                                    std::span<const MorphTarget> morph_targets,
                                    WriteReport& report) {
  GltfPatch patch(source, mesh, report);
  if (!morph_targets.empty()) return patch.run_as_morph_targets(morph_targets, target);
  return source.describes(mesh) ? patch.run(target) : patch.run_with_new_triangles(target);
}

}  // namespace lapwing
