#include "lapwing/io/gltf_splice.h"

#include <algorithm>
#include <map>
#include <set>
#include <span>

#include "lapwing/base/errors.h"
#include "lapwing/io/gltf_instances.h"
#include "lapwing/io/gltf_writer.h"
#include "lapwing/json/json_text.h"

namespace lapwing {
namespace {

class Splice {
 public:
  Splice(const GltfLayout& layout, const Mesh& mesh, GltfNumbers& numbers, TextEdits& edits,
         WriteReport& report)
      : layout_(layout),
        mesh_(mesh),
        appender_(numbers.appender()),
        edits_(edits),
        report_(report),
        text_(layout.file.json()) {}

  void run() {
    const std::vector<std::vector<Index>> faces = faces_of_objects();
    const std::vector<std::vector<Index>> old = records_of_objects();
    std::map<std::size_t, std::vector<std::size_t>> changed;  // changed objects of each mesh
    for (std::size_t k = 0; k < faces.size(); ++k) {
      if (!is_as_before(old[k], faces[k])) changed[layout_.objects[k].mesh].push_back(k);
    }
    for (const auto& [mesh, objects] : changed) {
      const std::vector<std::string> others = others_showing(layout_, objects);
      for (const std::size_t k : objects) {
        // If only one object changed, its new triangles replace those of the mesh. All other
        // objects that show the mesh then change with it. GltfPatch does the same with positions.
        const bool keeps_mesh = objects.size() == 1 || (others.empty() && k == objects.front());
        replace(layout_.objects[k], faces[k], !keeps_mesh);
      }
      if (objects.size() > 1) {
        report_.notes.push_back(note_of_separation(layout_, objects));
      } else if (!others.empty()) {
        report_.notes.push_back(note_of_shared_edit(layout_, objects, others));
      }
    }
    append_to_list(text_, text_.root(), "meshes", new_meshes_, edits_);
    add_materials();
  }

 private:
  std::vector<std::vector<Index>> faces_of_objects() const {
    std::map<std::string, std::size_t> by_name;
    for (std::size_t k = 0; k < layout_.objects.size(); ++k) {
      by_name.emplace(layout_.objects[k].name, k);
    }
    const MeshAttributes& a = mesh_.attributes();
    std::vector<std::size_t> object_of_group;
    for (const std::string& group : a.groups) {
      const auto object = by_name.find(group);
      object_of_group.push_back(object == by_name.end() ? 0 : object->second);
    }
    std::vector<std::vector<Index>> faces(layout_.objects.size());
    for (Index f = 0; f < mesh_.face_count(); ++f) {
      const Index group = a.face_groups.empty() ? kNoIndex : a.face_groups[f];
      faces[group == kNoIndex ? 0 : object_of_group[group]].push_back(f);
    }
    return faces;
  }

  // Returns, for each object, the records of its corners before the edit.
  std::vector<std::vector<Index>> records_of_objects() const {
    std::vector<std::vector<Index>> records(layout_.objects.size());
    for (const Index record : layout_.record_of_corner) {
      records[set_of(record).object].push_back(record);
    }
    return records;
  }

  // Returns whether the faces of an object and their positions are unchanged.
  bool is_as_before(std::span<const Index> old, std::span<const Index> faces) const {
    if (old.size() != 3 * faces.size()) return false;
    for (std::size_t k = 0; k < faces.size(); ++k) {
      const auto face = mesh_.face(faces[k]);
      if (face.size() != 3) return false;
      for (std::size_t c = 0; c < 3; ++c) {
        const GltfRecords& set = set_of(old[3 * k + c]);
        const std::size_t element = old[3 * k + c] - set.first_record;
        if (layout_.position(set, element) != mesh_.positions[face[c]]) return false;
      }
    }
    return true;
  }

  const GltfRecords& set_of(Index record) const {
    const auto after = std::ranges::upper_bound(layout_.records, std::size_t{record}, {},
                                                &GltfRecords::first_record);
    return *std::prev(after);
  }

  // If `is_separate`, the object gets its own mesh, and the shared mesh stays unchanged.
  void replace(const GltfObject& object, const std::vector<Index>& faces, bool is_separate) {
    const JsonNode mesh = layout_.file.root().at("meshes").at(object.mesh);
    const JsonPlace place = text_.element("meshes", object.mesh);
    std::set<std::string> lost;
    for (const JsonNode& primitive : mesh.at("primitives").elements()) {
      if (primitive.has("targets")) {
        primitive.fail("'" + object.name +
                       "' has morph targets, which do not fit its new triangles; save another "
                       "format, or export the object without morph targets");
      }
      for (const std::string& name : primitive.at("attributes").keys()) lost.insert(name);
    }
    for (const char* carried : {"POSITION", "NORMAL", "TEXCOORD_0", "COLOR_0"}) lost.erase(carried);
    for (const std::string& name : lost) {
      report_.not_carried.push_back("attribute " + name + " of '" + object.name +
                                    "': the new triangles have no values for it");
    }
    const std::string primitives =
        add_primitives(mesh_, std::span(&faces, 1), object.to_world.inverse(), appender_).front();
    if (primitives.empty()) {
      throw InputError("'" + object.name +
                       "' has no triangles left, but a glTF mesh needs at least one; keep some");
    }
    if (is_separate) {
      require_own_node(object);
      const JsonPlace node = text_.element("nodes", object.node);
      edits_.replace(text_.at(node, "mesh"), std::to_string(mesh_count_++));
      if (!new_meshes_.empty()) new_meshes_ += ',';
      new_meshes_ +=
          R"({"name":)" + quoted_json(object.name) + R"(,"primitives":[)" + primitives + "]}";
    } else {
      edits_.replace(text_.at(place, "primitives"), "[" + primitives + "]");
    }
    if (object.has_skin) remove_skin(object, is_separate);
  }

  void remove_skin(const GltfObject& object, bool is_separate) {
    const std::vector<JsonNode> nodes = layout_.file.root().at("nodes").elements();
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const auto shown = nodes[k].find("mesh");
      const bool shows_it = is_separate ? k == object.node : shown && shown->count() == object.mesh;
      if (shows_it) remove_member(text_, text_.element("nodes", k), "skin", edits_);
    }
    report_.not_carried.push_back("the skin of '" + object.name +
                                  "': the new triangles have no joint weights");
  }

  // Adds the materials that are not in the file, such as those of a transplanted part.
  void add_materials() {
    const auto list = layout_.file.root().find("materials");
    const std::size_t known = list ? list->elements().size() : 0;
    const std::span<const std::string> names = mesh_.attributes().materials;
    const std::string added = named_materials(names.subspan(std::min(known, names.size())));
    append_to_list(text_, text_.root(), "materials", added, edits_);
  }

  const GltfLayout& layout_;
  const Mesh& mesh_;
  GltfAppender& appender_;
  TextEdits& edits_;
  WriteReport& report_;
  const JsonText& text_;
  std::size_t mesh_count_ = layout_.file.root().at("meshes").elements().size();
  std::string new_meshes_;
};

}  // namespace

void replace_triangles(const GltfLayout& layout, const Mesh& mesh, GltfNumbers& numbers,
                       TextEdits& edits, WriteReport& report) {
  Splice(layout, mesh, numbers, edits, report).run();
}

}  // namespace lapwing
