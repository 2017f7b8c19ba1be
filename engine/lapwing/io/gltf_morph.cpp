#include "lapwing/io/gltf_morph.h"

#include <algorithm>
#include <map>
#include <optional>
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

// Returns the index of an accessor of a primitive, or nullopt if the primitive has none.
std::optional<std::size_t> number_of(const JsonNode& attributes, const char* name) {
  const auto node = attributes.find(name);
  return node ? std::optional(node->count()) : std::nullopt;
}

bool has_records(const JsonNode& attributes, const GltfRecords& set) {
  const auto normals = set.normals ? std::optional(set.normals->number()) : std::nullopt;
  return number_of(attributes, "POSITION") == set.positions.number() &&
         number_of(attributes, "NORMAL") == normals;
}

// Returns the names of the morph targets of a glTF mesh. A target without a name is "target 2".
std::vector<std::string> target_names(const JsonNode& mesh, std::size_t count) {
  std::vector<std::string> names;
  const auto extras = mesh.find("extras");
  const auto list = extras && extras->is_object() ? extras->find("targetNames") : std::nullopt;
  if (list) {
    for (const JsonNode& name : list->elements()) {
      names.push_back(name.is_string() ? name.string() : "target " + std::to_string(names.size()));
    }
  }
  while (names.size() < count) names.push_back("target " + std::to_string(names.size()));
  return names;
}

// A morph target, and the mesh at the weight 1.
struct PosedMesh {
  const std::string& name;
  Mesh mesh;
  std::vector<Vector3d> normals;
  std::set<std::size_t> left_out;  // objects that do not define this morph target
};

class MorphTargets {
 public:
  MorphTargets(const GltfLayout& layout, const Mesh& mesh, std::span<const MorphTarget> targets,
               GltfNumbers& numbers, TextEdits& edits)
      : layout_(layout),
        appender_(numbers.appender()),
        edits_(edits),
        text_(layout.file.json()),
        rest_(source_positions(layout.file.source(), mesh)) {
    for (const MorphTarget& target : targets) {
      PosedMesh posed{target.name, mesh, mesh.attributes().normals, {}};
      posed.mesh.positions = target.positions;
      if (!posed.normals.empty()) posed.normals = updated_normals(posed.mesh, rest_).normals;
      choose_instances(posed);
      poses_.push_back(std::move(posed));
    }
  }

  void run() {
    std::set<std::size_t> meshes;
    for (const PosedMesh& pose : poses_) {
      for (const GltfRecords& set : layout_.records) {
        for (std::size_t k = 0; k < set.count(); ++k) {
          const Index v = layout_.vertex_of_record[set.first_record + k];
          if (!are_same(pose.mesh.positions[v], rest_[v])) {
            meshes.insert(layout_.objects[set.object].mesh);
          }
        }
      }
    }
    if (meshes.empty()) {
      throw InputError("nothing moved, so the morph target '" + poses_.front().name +
                       "' would be empty; edit the mesh first");
    }
    for (const std::size_t m : meshes) add_to_mesh(m);
    extend_nodes(meshes);
    extend_animations();
  }

 private:
  // If several objects show one mesh, the first object that moved defines the morph target.
  void choose_instances(PosedMesh& pose) const {
    for (const MovedInstances& instances : moved_instances(layout_, pose.mesh)) {
      if (!instances.are_alike) {
        throw InputError(names_of(layout_, instances.moved) +
                         " show one mesh but moved differently, so it cannot get one morph target; "
                         "move only one of them");
      }
      for (const std::size_t object : instances.objects) {
        if (object != instances.moved.front()) pose.left_out.insert(object);
      }
    }
  }

  // Returns the records of a primitive; null for points and lines, which do not move.
  const GltfRecords* records_of(std::size_t mesh, const JsonNode& attributes,
                                const PosedMesh& pose) const {
    for (const GltfRecords& set : layout_.records) {
      if (layout_.objects[set.object].mesh != mesh || pose.left_out.contains(set.object)) continue;
      if (has_records(attributes, set)) return &set;
    }
    return nullptr;
  }

  std::string displacements(const GltfRecords& set, const PosedMesh& pose) {
    const Eigen::Matrix3d linear = layout_.objects[set.object].to_world.linear();
    const Eigen::Matrix3d to_local = linear.inverse();
    const Mesh& mesh = pose.mesh;
    std::vector<Vector3d> rows;
    std::vector<Vector3d> turns;
    for (std::size_t k = 0; k < set.count(); ++k) {
      const Index v = layout_.vertex_of_record[set.first_record + k];
      const bool is_still = are_same(mesh.positions[v], rest_[v]);
      rows.emplace_back(is_still ? Vector3d(Vector3d::Zero())
                                 : Vector3d(to_local * (mesh.positions[v] - rest_[v])));
      if (!set.normals) continue;
      const Index n = layout_.normal_of_record[set.first_record + k];
      const bool stays = are_same(pose.normals[n], mesh.attributes().normals[n]);
      const Vector3d turn =
          (linear.transpose() * pose.normals[n]).normalized() - set.normals->vector3(k);
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
    const auto targets = primitives.at(0).find("targets");
    old_targets_[number] = targets ? targets->elements().size() : 0;
    std::vector<std::string> new_targets(primitives.size());
    for (const PosedMesh& pose : poses_) {
      std::map<const GltfRecords*, std::string> known;
      for (std::size_t p = 0; p < primitives.size(); ++p) {
        const JsonNode attributes = primitives[p].at("attributes");
        const GltfRecords* const set = records_of(number, attributes, pose);
        std::string& target = known[set];
        if (set == nullptr) target = nothing(attributes);
        if (target.empty()) target = displacements(*set, pose);
        new_targets[p] += (new_targets[p].empty() ? "" : ",") + target;
      }
    }
    for (std::size_t p = 0; p < primitives.size(); ++p) {
      append_to_list(text_, places[p], "targets", new_targets[p], edits_);
    }
    if (mesh.has("weights")) append_to_list(text_, place, "weights", zeros(), edits_);
    add_names(mesh, place, old_targets_[number]);
  }

  void add_names(const JsonNode& mesh, JsonPlace place, std::size_t old_targets) {
    const std::vector<std::string> old = target_names(mesh, old_targets);
    std::string added;
    for (const PosedMesh& pose : poses_) {
      added += (added.empty() ? "" : ",") + quoted_json(pose.name);
    }
    std::string all;
    for (const std::string& name : old) all += quoted_json(name) + ",";
    all += added;
    const auto extras = mesh.find("extras");
    if (!extras) {
      edits_.insert(place.end - 1, R"(,"extras":{"targetNames":[)" + all + "]}");
      return;
    }
    if (!extras->is_object()) return;  // application-specific data
    const auto list = extras->find("targetNames");
    const JsonPlace extras_place = text_.at(place, "extras");
    if (list) {
      for (const PosedMesh& pose : poses_) {
        if (std::ranges::find(old, pose.name) == old.end()) continue;
        list->fail("a morph target '" + pose.name + "' already exists; choose another name");
      }
    }
    append_to_list(text_, extras_place, "targetNames", list ? added : all, edits_);
  }

  // Returns a 0 for each morph target, separated by commas.
  std::string zeros() const {
    std::string list = "0";
    for (std::size_t k = 1; k < poses_.size(); ++k) list += ",0";
    return list;
  }

  void extend_nodes(const std::set<std::size_t>& meshes) {
    const std::vector<JsonNode> nodes = layout_.file.root().at("nodes").elements();
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const auto mesh = nodes[k].find("mesh");
      if (!mesh || !meshes.contains(mesh->count())) continue;
      mesh_of_node_[k] = mesh->count();
      if (nodes[k].has("weights")) {
        append_to_list(text_, text_.element("nodes", k), "weights", zeros(), edits_);
      }
    }
  }

  // Appends zeros to each key of the animations of weights.
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
      if (k % old_targets + 1 == old_targets) bytes.append(poses_.size() * sizeof(float), '\0');
    }
    return appender_.add_numbers(bytes, Scalar::float32, "SCALAR",
                                 old.count() + old.count() / old_targets * poses_.size(),
                                 GltfAppender::Target::none);
  }

  const GltfLayout& layout_;
  GltfAppender& appender_;
  TextEdits& edits_;
  const JsonText& text_;
  Positions rest_;
  std::vector<PosedMesh> poses_;
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

void add_morph_targets(const GltfLayout& layout, const Mesh& mesh,
                       std::span<const MorphTarget> targets, GltfNumbers& numbers,
                       TextEdits& edits) {
  MorphTargets(layout, mesh, targets, numbers, edits).run();
}

std::vector<MorphTarget> read_morph_targets(const Mesh& mesh) {
  std::vector<MorphTarget> found;
  if (mesh.source == nullptr || !mesh.source->gltf) return found;
  const GltfLayout& layout = *mesh.source->gltf;
  const Positions rest = source_positions(*mesh.source, mesh);
  const auto positions_of = [&](const std::string& name) -> Positions& {
    const auto known = std::ranges::find(found, name, &MorphTarget::name);
    if (known != found.end()) return known->positions;
    found.push_back({name, rest});
    return found.back().positions;
  };
  for (const GltfRecords& set : layout.records) {
    const GltfObject& object = layout.objects[set.object];
    const JsonNode in_file = layout.file.root().at("meshes").at(object.mesh);
    for (const JsonNode& primitive : in_file.at("primitives").elements()) {
      const auto targets = primitive.find("targets");
      if (!targets || !has_records(primitive.at("attributes"), set)) continue;
      const std::vector<JsonNode> list = targets->elements();
      const std::vector<std::string> names = target_names(in_file, list.size());
      for (std::size_t t = 0; t < list.size(); ++t) {
        Positions& positions = positions_of(names[t]);
        const auto number = number_of(list[t], "POSITION");
        if (!number) continue;
        const GltfAccessor displacements(layout.file, *number);
        if (displacements.components() != 3 || displacements.count() != set.count()) {
          list[t].fail("expected a displacement of three numbers for each of the " +
                       std::to_string(set.count()) + " vertices; export the file again");
        }
        for (std::size_t k = 0; k < set.count(); ++k) {
          const Index v = layout.vertex_of_record[set.first_record + k];
          positions[v] = rest[v] + object.to_world.linear() * displacements.vector3(k);
        }
      }
    }
  }
  return found;
}

}  // namespace lapwing
