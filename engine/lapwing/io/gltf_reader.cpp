#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <utility>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/limits.h"
#include "lapwing/base/srgb.h"
#include "lapwing/io/gltf_morph.h"
#include "lapwing/io/gltf_scene.h"
#include "lapwing/io/reading.h"
#include "lapwing/mesh/welder.h"

namespace lapwing {
namespace {

// Primitive modes with triangles.
constexpr std::size_t kTriangles = 4;
constexpr std::size_t kTriangleStrip = 5;
constexpr std::size_t kTriangleFan = 6;

class GltfReader {
 public:
  explicit GltfReader(SourceFile& file)
      : source_(file), layout_(std::make_unique<GltfLayout>(file)) {}

  Mesh read() {
    layout_->objects = find_objects(layout_->file, source_.object(), source_.notes);
    note_morph_weights(*layout_, source_.notes);
    attributes_.materials = gltf_material_names(layout_->file.root());
    attributes_.groups_are_objects = true;
    for (std::size_t k = 0; k < layout_->objects.size(); ++k) {
      const std::size_t before = std::max(mesh_.face_count(), mesh_.vertex_count());
      require_few_copies(layout_->objects[k]);
      read_object(k);
      const std::size_t now = std::max(mesh_.face_count(), mesh_.vertex_count());
      triangles_of_.try_emplace(layout_->objects[k].mesh, now - before);
    }
    note_shared_meshes();
    drop_what_no_face_has();
    note_the_rest();
    attributes_.uneditable = uneditable_.lines();
    source_.gltf = std::move(layout_);
    return std::move(mesh_);
  }

 private:
  // Accessors of a primitive's attributes, in the order of key_of.
  using Key = std::array<std::size_t, 5>;
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

  struct Place {
    std::size_t first_record = 0;
    std::size_t count = 0;
  };

  // Limits the number of copied triangles, because many nodes of a short file can show one large
  // mesh.
  void require_few_copies(const GltfObject& object) {
    const auto known = triangles_of_.find(object.mesh);
    if (known == triangles_of_.end()) return;
    copied_triangles_ += known->second;
    require_at_most(kMostTriangles, static_cast<double>(copied_triangles_),
                    source_.path().string() + ": the nodes that show a mesh again have",
                    "name one object, such as '" + source_.path().filename().string() + "#" +
                        object.name + "'");
  }

  void note_shared_meshes() {
    std::map<std::size_t, std::size_t> users;
    for (const GltfObject& object : layout_->objects) ++users[object.mesh];
    const auto shared = std::ranges::count_if(users, [](const auto& of) { return of.second > 1; });
    if (shared > 0) {
      uneditable_.add("meshes that several objects share", static_cast<std::size_t>(shared));
    }
  }

  void read_object(std::size_t number) {
    const GltfObject& object = layout_->objects[number];
    const JsonNode mesh = layout_->file.root().at("meshes").at(object.mesh);
    attributes_.groups.push_back(object.name);
    Welder welder(mesh_.positions);
    std::map<Key, Place> known;
    for (const JsonNode& primitive : mesh.at("primitives").elements()) {
      const auto mode_node = primitive.find("mode");
      const std::size_t mode = mode_node ? mode_node->count() : kTriangles;
      if (mode_node && mode > kTriangleFan) mode_node->fail_expecting("a mode from 0 to 6");
      if (mode < kTriangles) {
        uneditable_.add("primitives of points or lines");
        continue;
      }
      const JsonNode attributes = primitive.at("attributes");
      if (!attributes.has("POSITION")) {
        uneditable_.add("primitives without positions");
        continue;
      }
      const Key key = key_of(attributes);
      const auto [place, is_new] = known.try_emplace(key);
      if (is_new) place->second = read_records(number, attributes, key, welder);
      read_faces(primitive, mode, number, place->second);
      if (const auto targets = primitive.find("targets")) {
        uneditable_.add("morph targets", targets->elements().size());
      }
    }
    if (object.has_skin) uneditable_.add("skins");
  }

  static Key key_of(const JsonNode& attributes) {
    constexpr std::array<const char*, 5> kNames{"POSITION", "NORMAL", "TANGENT", "TEXCOORD_0",
                                                "COLOR_0"};
    Key key{};
    for (std::size_t k = 0; k < kNames.size(); ++k) {
      const auto node = attributes.find(kNames[k]);
      key[k] = node ? node->count() : kNone;
    }
    return key;
  }

  // Returns an accessor. Throws InputError unless it has `least` to `most` components and, if
  // `count` is not kNone, `count` elements.
  GltfAccessor accessor(const JsonNode& attributes, std::size_t number, std::size_t least,
                        std::size_t most, std::size_t count) const {
    GltfAccessor found(layout_->file, number);
    if (found.components() < least || found.components() > most) {
      attributes.fail("accessor " + std::to_string(number) + " has " +
                      std::to_string(found.components()) + " numbers per element, expected " +
                      std::to_string(least));
    }
    if (count != kNone && found.count() != count) {
      attributes.fail("accessor " + std::to_string(number) + " has " +
                      std::to_string(found.count()) + " elements, but the positions have " +
                      std::to_string(count));
    }
    return found;
  }

  Place read_records(std::size_t object, const JsonNode& attributes, const Key& key,
                     Welder& welder) {
    GltfRecords set{object,
                    layout_->vertex_of_record.size(),
                    accessor(attributes, key[0], 3, 3, kNone),
                    {},
                    {}};
    const std::size_t count = set.count();
    if (count >= kNoIndex - set.first_record) {
      attributes.fail("a mesh has at most 4,294,967,294 vertices");
    }
    if (key[1] != kNone) set.normals = accessor(attributes, key[1], 3, 3, count);
    if (key[2] != kNone) set.tangents = accessor(attributes, key[2], 4, 4, count);
    const auto note_sparse_indices = [&](const GltfAccessor& list) {
      if (const auto range = list.sparse_indices()) layout_->indices.push_back(*range);
    };
    note_sparse_indices(set.positions);
    if (set.normals) note_sparse_indices(*set.normals);
    if (set.tangents) note_sparse_indices(*set.tangents);
    CancelCheck cancel_check;
    for (std::size_t k = 0; k < count; ++k) {
      cancel_check();
      layout_->vertex_of_record.push_back(welder.vertex_at(layout_->position(set, k)));
    }
    read_normals(set);
    read_texture_coordinates(attributes, key[3], count);
    read_colors(attributes, key[4], set);
    layout_->records.push_back(std::move(set));
    return {layout_->records.back().first_record, count};
  }

  void read_normals(const GltfRecords& set) {
    if (!set.normals) {
      layout_->normal_of_record.resize(layout_->vertex_of_record.size(), kNoIndex);
      return;
    }
    const Eigen::Affine3d& to_world = layout_->objects[set.object].to_world;
    const bool stays = to_world.linear() == Eigen::Matrix3d::Identity();
    const Eigen::Matrix3d turn = to_world.linear().inverse().transpose();
    CancelCheck cancel_check;
    for (std::size_t k = 0; k < set.count(); ++k) {
      cancel_check();
      Eigen::Vector3d normal = set.normals->vector3(k);
      if (!stays) normal = (turn * normal).normalized();
      layout_->normal_of_record.push_back(
          normal_at(layout_->vertex_of_record[set.first_record + k], normal));
    }
  }

  // Returns the index of a normal; equal normals of a vertex share one.
  Index normal_at(Index vertex, const Eigen::Vector3d& normal) {
    first_normal_.resize(mesh_.positions.size(), kNoIndex);
    for (Index n = first_normal_[vertex]; n != kNoIndex; n = next_normal_[n]) {
      if (attributes_.normals[n] == normal) return n;
    }
    const auto added = static_cast<Index>(attributes_.normals.size());
    attributes_.normals.push_back(normal);
    next_normal_.push_back(std::exchange(first_normal_[vertex], added));
    return added;
  }

  // In glTF v runs downwards.
  void read_texture_coordinates(const JsonNode& attributes, std::size_t number, std::size_t count) {
    if (number == kNone) {
      uv_of_record_.resize(layout_->vertex_of_record.size(), kNoIndex);
      return;
    }
    const GltfAccessor list = accessor(attributes, number, 2, 2, count);
    for (std::size_t k = 0; k < count; ++k) {
      uv_of_record_.push_back(static_cast<Index>(attributes_.uvs.size()));
      attributes_.uvs.emplace_back(list.value(k, 0), 1.0 - list.value(k, 1));
    }
  }

  // A vertex gets the colour of its last record. In glTF, colours are linear.
  void read_colors(const JsonNode& attributes, std::size_t number, const GltfRecords& set) {
    if (number == kNone) return;
    const GltfAccessor list = accessor(attributes, number, 3, 4, set.count());
    attributes_.vertex_colors.resize(mesh_.positions.size(), Eigen::Vector4f::Ones());
    for (std::size_t k = 0; k < set.count(); ++k) {
      Eigen::Vector4f& color =
          attributes_.vertex_colors[layout_->vertex_of_record[set.first_record + k]];
      for (std::size_t c = 0; c < 3; ++c) {
        color[static_cast<Eigen::Index>(c)] = srgb_of_linear(static_cast<float>(list.value(k, c)));
      }
      color[3] = list.components() == 4 ? static_cast<float>(list.value(k, 3)) : 1.0F;
    }
  }

  void read_faces(const JsonNode& primitive, std::size_t mode, std::size_t object, Place place) {
    const auto material = primitive.find("material");
    const Index material_number = material ? static_cast<Index>(material->count()) : kNoIndex;
    if (material && material_number >= attributes_.materials.size()) {
      material->fail("the material does not exist; export the file again");
    }
    std::optional<GltfAccessor> indices;
    if (const auto node = primitive.find("indices")) {
      indices.emplace(layout_->file, node->count());
      if (indices->components() != 1 || indices->type() == Scalar::float32) {
        node->fail("expected an accessor of scalar integers");
      }
      if (const auto range = indices->range()) layout_->indices.push_back(*range);
    }
    const std::size_t count = indices ? indices->count() : place.count;
    // Returns kNoIndex if the corner names a missing vertex and the reader accepts damaged files.
    const auto record_at = [&](std::size_t k) {
      const double index = indices ? indices->value(k, 0) : static_cast<double>(k);
      if (!(index >= 0.0 && index < static_cast<double>(place.count))) {
        source_.report_defect(FileDefectKind::missing_vertex, primitive.where(),
                              "corner " + std::to_string(k) + " names vertex " +
                                  std::to_string(static_cast<std::int64_t>(index)) +
                                  ", but there are " + std::to_string(place.count));
        return kNoIndex;
      }
      return static_cast<Index>(place.first_record + static_cast<std::size_t>(index));
    };
    // A mirroring transform reverses the orientation of triangles.
    const bool is_mirrored = layout_->objects[object].to_world.linear().determinant() < 0.0;
    const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
      if (is_mirrored) std::swap(b, c);
      std::array<Index, 3> records{};
      for (std::size_t k = 0; const std::size_t corner : {a, b, c}) {
        records[k] = record_at(corner);
        if (records[k++] == kNoIndex) return;
      }
      add_face(records, material_number, static_cast<Index>(object));
    };
    CancelCheck cancel_check;
    const std::size_t step = mode == kTriangles ? 3 : 1;
    for (std::size_t k = 0; k + 2 < count; k += step) {
      cancel_check();
      if (mode == kTriangles) add(k, k + 1, k + 2);
      if (mode == kTriangleStrip) add(k, k + 1 + k % 2, k + 2 - k % 2);
      if (mode == kTriangleFan) add(k + 1, k + 2, 0);
    }
  }

  void add_face(std::array<Index, 3> records, Index material, Index object) {
    std::array<Index, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = layout_->vertex_of_record[records[k]];
      layout_->record_of_corner.push_back(records[k]);
      attributes_.corner_normals.push_back(layout_->normal_of_record[records[k]]);
      attributes_.corner_uvs.push_back(uv_of_record_[records[k]]);
    }
    faces_.vertices.insert(faces_.vertices.end(), corners.begin(), corners.end());
    close_face(source_, faces_, 0);
    attributes_.face_materials.push_back(material);
    attributes_.face_groups.push_back(object);
  }

  // Each attribute list must be empty or have full length.
  void drop_what_no_face_has() {
    if (attributes_.normals.empty()) attributes_.corner_normals.clear();
    if (attributes_.uvs.empty()) attributes_.corner_uvs.clear();
    if (attributes_.materials.empty()) attributes_.face_materials.clear();
    if (!attributes_.vertex_colors.empty()) {
      attributes_.vertex_colors.resize(mesh_.positions.size(), Eigen::Vector4f::Ones());
    }
  }

  void note_the_rest() {
    const JsonNode& root = layout_->file.root();
    for (const char* key : {"animations", "cameras"}) {
      const auto list = root.find(key);
      if (list && !list->elements().empty()) uneditable_.add(key, list->elements().size());
    }
    if (const auto used = root.find("extensionsUsed")) {
      for (const JsonNode& extension : used->elements()) {
        if (!extension.is_string() || is_carried_extension(extension.string())) continue;
        uneditable_.add("data of the extension " + extension.string());
      }
    }
    const auto images = root.find("images");
    const std::size_t count = images ? images->elements().size() : 0;
    const std::size_t base_colors = base_color_images(root).size();
    if (count > base_colors) uneditable_.add("images other than base colours", count - base_colors);
  }

  SourceFile& source_;
  std::unique_ptr<GltfLayout> layout_;
  Mesh mesh_;
  Faces& faces_ = mesh_.edit_faces();
  MeshAttributes& attributes_ = mesh_.edit_attributes();
  std::vector<Index> uv_of_record_;
  // Linked list of the normals of each vertex.
  std::vector<Index> first_normal_;
  std::vector<Index> next_normal_;
  std::map<std::size_t, std::size_t> triangles_of_;  // key: index of the mesh
  std::size_t copied_triangles_ = 0;
  Tally uneditable_;
};

}  // namespace

Mesh read_gltf(SourceFile& file) {
  file.encoding = Encoding::little_endian;
  return GltfReader(file).read();
}

}  // namespace lapwing
