#include "lapwing/io/gltf_splice.h"

#include <algorithm>
#include <set>

#include "lapwing/base/errors.h"
#include "lapwing/io/gltf_primitives.h"

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
    std::vector<std::vector<Index>> faces(layout_.objects.size());
    const std::vector<Index>& groups = mesh_.attributes().face_groups;
    for (Index f = 0; f < mesh_.face_count(); ++f) {
      const std::size_t group = groups.empty() ? 0 : groups[f];
      faces[group < faces.size() ? group : 0].push_back(f);
    }
    for (std::size_t k = 0; k < faces.size(); ++k) {
      if (!is_as_before(k, faces[k])) replace(layout_.objects[k], faces[k]);
    }
    add_materials();
  }

 private:
  // Whether the faces of an object and their positions are unchanged.
  bool is_as_before(std::size_t object, std::span<const Index> faces) const {
    std::vector<std::pair<const GltfRecords*, std::size_t>> old;
    for (const Index record : layout_.record_of_corner) {
      const GltfRecords& set = set_of(record);
      if (set.object == object) old.emplace_back(&set, record - set.first_record);
    }
    if (old.size() != 3 * faces.size()) return false;
    for (std::size_t k = 0; k < faces.size(); ++k) {
      const auto face = mesh_.face(faces[k]);
      if (face.size() != 3) return false;
      for (std::size_t c = 0; c < 3; ++c) {
        const auto& [set, element] = old[3 * k + c];
        if (layout_.position(*set, element) != mesh_.positions[face[c]]) return false;
      }
    }
    return true;
  }

  const GltfRecords& set_of(Index record) const {
    const auto after = std::ranges::upper_bound(layout_.records, std::size_t{record}, {},
                                                &GltfRecords::first_record);
    return *std::prev(after);
  }

  void replace(const GltfObject& object, std::span<const Index> faces) {
    const JsonNode mesh = *layout_.file.root().at("meshes").element(object.mesh);
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
        add_primitives(mesh_, faces, object.to_world.inverse(), 0, appender_);
    if (primitives.empty()) {
      throw InputError("'" + object.name +
                       "' has no triangles left, but a glTF mesh needs at least one; keep some");
    }
    edits_.replace(*text_.member(place, "primitives"), "[" + primitives + "]");
    if (!object.has_skin) return;
    const std::vector<JsonNode> nodes = layout_.file.root().at("nodes").elements();
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const auto shown = nodes[k].find("mesh");
      if (shown && shown->count() == object.mesh) {
        remove_member(text_, text_.element("nodes", k), "skin", edits_);
      }
    }
    report_.not_carried.push_back("the skin of '" + object.name +
                                  "': the new triangles have no joint weights");
  }

  // Adds the materials that are not in the file, such as those of a transplanted part.
  void add_materials() {
    const auto list = layout_.file.root().find("materials");
    const std::size_t known = list ? list->elements().size() : 0;
    const std::vector<std::string>& names = mesh_.attributes().materials;
    std::string added;
    for (std::size_t k = known; k < names.size(); ++k) {
      added += (added.empty() ? "" : ",") + (R"({"name":)" + quoted_json(names[k])) + "}";
    }
    append_to_list(text_, text_.root(), "materials", added, edits_);
  }

  const GltfLayout& layout_;
  const Mesh& mesh_;
  GltfAppender& appender_;
  TextEdits& edits_;
  WriteReport& report_;
  JsonText text_;
};

}  // namespace

void splice_triangles(const GltfLayout& layout, const Mesh& mesh, GltfNumbers& numbers,
                      TextEdits& edits, WriteReport& report) {
  Splice(layout, mesh, numbers, edits, report).run();
}

}  // namespace lapwing
