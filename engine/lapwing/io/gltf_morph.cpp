#include "lapwing/io/gltf_morph.h"

#include <algorithm>
#include <map>
#include <set>

#include "lapwing/base/errors.h"
#include "lapwing/base/printable_text.h"
#include "lapwing/io/binary_numbers.h"
#include "lapwing/io/gltf_instances.h"
#include "lapwing/io/source_file.h"
#include "lapwing/io/stored_normals.h"
#include "lapwing/io/writing.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

// Adds a VEC3 accessor, sparse because most rows are 0, and returns its index.
std::size_t add_rows(const std::vector<Vector3d>& rows, bool with_bounds, GltfAppender& appender) {
  std::string indices;
  std::string values;
  std::size_t moved = 0;
  Eigen::Vector3f least = Eigen::Vector3f::Zero();
  Eigen::Vector3f most = Eigen::Vector3f::Zero();
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const Eigen::Vector3f row = rows[k].cast<float>();
    if (k == 0) least = most = row;
    least = least.cwiseMin(row);
    most = most.cwiseMax(row);
    if (row.isZero(0.0F)) continue;
    ++moved;
    append_binary(indices, static_cast<double>(k), Scalar::uint32, Encoding::little_endian);
    for (const float x : row) {
      append_binary(values, double{x}, Scalar::float32, Encoding::little_endian);
    }
  }
  std::string json =
      R"({"componentType":5126,"type":"VEC3","count":)" + std::to_string(rows.size());
  if (with_bounds) {
    const auto list = [](const Eigen::Vector3f& bound) {
      std::string text;
      for (const float x : bound) {
        text += text.empty() ? "[" : ",";
        append_number(text, x);
      }
      return text + "]";
    };
    json += R"(,"min":)" + list(least) + R"(,"max":)" + list(most);
  }
  if (moved > 0) {
    const std::size_t index_view = appender.add_view(indices, GltfAppender::Target::none);
    const std::size_t value_view = appender.add_view(values, GltfAppender::Target::none);
    json += R"(,"sparse":{"count":)" + std::to_string(moved) + R"(,"indices":{"bufferView":)" +
            std::to_string(index_view) + R"(,"componentType":5125},"values":{"bufferView":)" +
            std::to_string(value_view) + "}}";
  }
  return appender.add_accessor(json + "}");
}

class MorphTarget {
 public:
  MorphTarget(const GltfLayout& layout, const Mesh& mesh, const std::string& name,
              GltfNumbers& numbers, TextEdits& edits)
      : layout_(layout),
        mesh_(mesh),
        name_(name),
        appender_(numbers.appender()),
        edits_(edits),
        text_(layout.file.json()),
        rest_(source_positions(layout.file.source(), mesh)),
        normals_(mesh.attributes().normals) {
    if (!normals_.empty()) normals_ = updated_normals(mesh, rest_).normals;
  }

  void run() {
    choose_instances();
    std::set<std::size_t> meshes;
    for (const GltfRecords& set : layout_.records) {
      for (std::size_t k = 0; k < set.count(); ++k) {
        const Index v = layout_.vertex_of_record[set.first_record + k];
        if (!are_same(mesh_.positions[v], rest_[v]))
          meshes.insert(layout_.objects[set.object].mesh);
      }
    }
    if (meshes.empty()) {
      throw InputError("nothing moved, so the morph target '" + name_ +
                       "' would be empty; edit the mesh first");
    }
    for (const std::size_t m : meshes) add_to_mesh(m);
    extend_nodes(meshes);
    extend_animations();
  }

 private:
  // If several objects show one mesh, the first object that moved defines the morph target.
  void choose_instances() {
    for (const MovedInstances& instances : moved_instances(layout_, mesh_)) {
      if (!instances.are_alike) {
        throw InputError(names_of(layout_, instances.moved) +
                         " show one mesh but moved differently, so it cannot get one morph target; "
                         "move only one of them");
      }
      for (const std::size_t object : instances.objects) {
        if (object != instances.moved.front()) left_out_.insert(object);
      }
    }
  }

  // Returns the records of a primitive; null for points and lines, which do not move.
  const GltfRecords* records_of(std::size_t mesh, const JsonNode& attributes) const {
    const auto number_of = [&](const char* name) {
      const auto node = attributes.find(name);
      return node ? std::optional(node->count()) : std::nullopt;
    };
    for (const GltfRecords& set : layout_.records) {
      if (layout_.objects[set.object].mesh != mesh || left_out_.contains(set.object)) continue;
      const auto normals = set.normals ? std::optional(set.normals->number()) : std::nullopt;
      if (number_of("POSITION") == set.positions.number() && number_of("NORMAL") == normals) {
        return &set;
      }
    }
    return nullptr;
  }

  std::string displacements(const GltfRecords& set) {
    const Eigen::Matrix3d linear = layout_.objects[set.object].to_world.linear();
    const Eigen::Matrix3d to_local = linear.inverse();
    std::vector<Vector3d> rows;
    std::vector<Vector3d> turns;
    for (std::size_t k = 0; k < set.count(); ++k) {
      const Index v = layout_.vertex_of_record[set.first_record + k];
      const bool is_still = are_same(mesh_.positions[v], rest_[v]);
      rows.emplace_back(is_still ? Vector3d(Vector3d::Zero())
                                 : Vector3d(to_local * (mesh_.positions[v] - rest_[v])));
      if (!set.normals) continue;
      const Index n = layout_.normal_of_record[set.first_record + k];
      const bool stays = are_same(normals_[n], mesh_.attributes().normals[n]);
      const Vector3d turn =
          (linear.transpose() * normals_[n]).normalized() - set.normals->vector3(k);
      turns.push_back(stays ? Vector3d::Zero() : turn);
    }
    std::string json = R"({"POSITION":)" + std::to_string(add_rows(rows, true, appender_));
    if (set.normals) json += R"(,"NORMAL":)" + std::to_string(add_rows(turns, false, appender_));
    return json + "}";
  }

  std::string nothing(const JsonNode& attributes) {
    const GltfAccessor positions(layout_.file, attributes.at("POSITION").count());
    const std::vector<Vector3d> rows(positions.count(), Vector3d::Zero());
    return R"({"POSITION":)" + std::to_string(add_rows(rows, true, appender_)) + "}";
  }

  void add_to_mesh(std::size_t number) {
    const JsonNode mesh = layout_.file.root().at("meshes").at(number);
    const JsonPlace place = text_.element("meshes", number);
    const std::vector<JsonNode> primitives = mesh.at("primitives").elements();
    const std::vector<JsonPlace> places = text_.elements(text_.at(place, "primitives"));
    std::map<const GltfRecords*, std::string> known;
    const auto targets = primitives.at(0).find("targets");
    old_targets_[number] = targets ? targets->elements().size() : 0;
    for (std::size_t p = 0; p < primitives.size(); ++p) {
      const JsonNode attributes = primitives[p].at("attributes");
      const GltfRecords* const set = records_of(number, attributes);
      std::string& target = known[set];
      if (set == nullptr) target = nothing(attributes);
      if (target.empty()) target = displacements(*set);
      append_to_list(text_, places[p], "targets", target, edits_);
    }
    if (mesh.has("weights")) append_to_list(text_, place, "weights", "0", edits_);
    add_name(mesh, place, old_targets_[number]);
  }

  void add_name(const JsonNode& mesh, JsonPlace place, std::size_t old_targets) {
    const auto extras = mesh.find("extras");
    if (!extras) {
      edits_.insert(place.end - 1, R"(,"extras":{"targetNames":[)" + names(old_targets) + "]}");
      return;
    }
    if (!extras->is_object()) return;  // application-specific data
    const auto list = extras->find("targetNames");
    const JsonPlace extras_place = text_.at(place, "extras");
    if (!list) {
      append_to_list(text_, extras_place, "targetNames", names(old_targets), edits_);
      return;
    }
    for (const JsonNode& name : list->elements()) {
      if (name.is_string() && name.string() == name_) {
        name.fail("a morph target '" + name_ + "' already exists; choose another name");
      }
    }
    append_to_list(text_, extras_place, "targetNames", quoted_json(name_), edits_);
  }

  // Returns names for the old targets, which have none, and the new name.
  std::string names(std::size_t old_targets) const {
    std::string list;
    for (std::size_t k = 0; k < old_targets; ++k) {
      list += quoted_json("target " + std::to_string(k)) + ",";
    }
    return list + quoted_json(name_);
  }

  void extend_nodes(const std::set<std::size_t>& meshes) {
    const std::vector<JsonNode> nodes = layout_.file.root().at("nodes").elements();
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const auto mesh = nodes[k].find("mesh");
      if (!mesh || !meshes.contains(mesh->count())) continue;
      mesh_of_node_[k] = mesh->count();
      if (nodes[k].has("weights")) {
        append_to_list(text_, text_.element("nodes", k), "weights", "0", edits_);
      }
    }
  }

  // Appends a 0 to each key of the animations of weights.
  void extend_animations() {
    const auto animations = layout_.file.root().find("animations");
    if (!animations) return;
    const std::vector<JsonNode> all = animations->elements();
    for (std::size_t a = 0; a < all.size(); ++a) {
      const auto samplers = text_.elements(text_.at(text_.element("animations", a), "samplers"));
      std::set<std::size_t> done;
      for (const JsonNode& channel : all[a].at("channels").elements()) {
        const JsonNode target = channel.at("target");
        const auto node = target.find("node");
        if (target.at("path").string() != "weights" || !node) continue;
        const auto mesh = mesh_of_node_.find(node->count());
        const std::size_t sampler = channel.at("sampler").count();
        if (mesh == mesh_of_node_.end() || !done.insert(sampler).second) continue;
        const JsonNode values = all[a].at("samplers").at(sampler).at("output");
        edits_.replace(text_.at(samplers.at(sampler), "output"),
                       std::to_string(with_zeros(values, old_targets_.at(mesh->second))));
      }
    }
  }

  std::size_t with_zeros(const JsonNode& output, std::size_t old_targets) {
    const GltfAccessor old(layout_.file, output.count());
    if (old_targets == 0 || old.count() % old_targets != 0) {
      output.fail("expected " + std::to_string(old_targets) +
                  " weights for each key of the animation; export the file again");
    }
    std::string bytes;
    for (std::size_t k = 0; k < old.count(); ++k) {
      append_binary(bytes, old.value(k, 0), Scalar::float32, Encoding::little_endian);
      if (k % old_targets + 1 == old_targets) bytes.append(sizeof(float), '\0');
    }
    return appender_.add_numbers(bytes, Scalar::float32, "SCALAR",
                                 old.count() + old.count() / old_targets,
                                 GltfAppender::Target::none);
  }

  const GltfLayout& layout_;
  const Mesh& mesh_;
  const std::string& name_;
  GltfAppender& appender_;
  TextEdits& edits_;
  const JsonText& text_;
  Positions rest_;
  std::vector<Vector3d> normals_;
  std::set<std::size_t> left_out_;                  // objects that define no morph target
  std::map<std::size_t, std::size_t> old_targets_;  // number of targets that each mesh had
  std::map<std::size_t, std::size_t> mesh_of_node_;
};

}  // namespace

void note_morph_weights(const GltfLayout& layout, std::vector<std::string>& notes) {
  constexpr std::size_t kMostWeights = 5;
  const JsonNode& root = layout.file.root();
  std::vector<std::string> names;
  std::vector<double> weights;
  for (const GltfObject& object : layout.objects) {
    try {
      auto list = root.at("nodes").at(object.node).find("weights");
      if (!list) list = root.at("meshes").at(object.mesh).find("weights");
      std::vector<double> numbers = list ? list->numbers() : std::vector<double>();
      std::erase(numbers, 0.0);
      if (numbers.empty()) continue;
      names.push_back(object.name);
      weights.insert(weights.end(), numbers.begin(), numbers.end());
    } catch (const InputError&) {
      // Malformed weights do not prevent editing the base shape.
    }
  }
  if (names.empty()) return;
  std::string shown;
  for (std::size_t k = 0; k < std::min(weights.size(), kMostWeights); ++k) {
    if (k > 0) shown += ", ";
    append_number(shown, weights[k]);
  }
  if (weights.size() > kMostWeights) shown += ", ...";
  notes.push_back(layout.file.source().path().string() + ": " + quoted_list(names) +
                  (names.size() == 1 ? " is" : " are") + " read without the morph weights " +
                  shown +
                  ", because an edit changes the base shape; the weights stay in the file. To edit "
                  "the weighted shape, apply the morph targets first");
}

void add_morph_target(const GltfLayout& layout, const Mesh& mesh, const std::string& name,
                      GltfNumbers& numbers, TextEdits& edits) {
  MorphTarget(layout, mesh, name, numbers, edits).run();
}

}  // namespace lapwing
