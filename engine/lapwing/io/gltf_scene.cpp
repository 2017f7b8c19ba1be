#include "lapwing/io/gltf_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "lapwing/base/errors.h"
#include "lapwing/base/printable_text.h"
#include "lapwing/json/suggest.h"

namespace lapwing {
namespace {

using Eigen::Affine3d;

std::vector<double> numbers_at(const JsonNode& node, std::size_t count) {
  std::vector<double> numbers = node.numbers();
  if (numbers.size() != count) node.fail_expecting(std::to_string(count) + " numbers");
  return numbers;
}

// `xyzw` is in the order of glTF files.
Eigen::Quaterniond unit_quaternion(const JsonNode& node, const Eigen::Vector4d& xyzw) {
  if (!(xyzw.norm() > 0.0)) node.fail("expected a quaternion other than 0");
  return Eigen::Quaterniond(xyzw).normalized();
}

Affine3d local_transform(const JsonNode& node) {
  Affine3d transform = Affine3d::Identity();
  if (const auto matrix = node.find("matrix")) {
    const std::vector<double> m = numbers_at(*matrix, 16);
    transform.matrix() = Eigen::Map<const Eigen::Matrix4d>(m.data());
    if (transform.matrix().row(3) != Eigen::RowVector4d(0.0, 0.0, 0.0, 1.0)) {
      matrix->fail("the last row of a node's matrix must be 0, 0, 0, 1");
    }
    return transform;
  }
  if (const auto move = node.find("translation")) {
    const std::vector<double> t = numbers_at(*move, 3);
    transform.translate(Eigen::Vector3d(t[0], t[1], t[2]));
  }
  if (const auto turn = node.find("rotation")) {
    const std::vector<double> q = numbers_at(*turn, 4);
    transform.rotate(unit_quaternion(*turn, {q[0], q[1], q[2], q[3]}));
  }
  if (const auto factor = node.find("scale")) {
    const std::vector<double> s = numbers_at(*factor, 3);
    transform.scale(Eigen::Vector3d(s[0], s[1], s[2]));
  }
  return transform;
}

// Returns the transforms of the instances that EXT_mesh_gpu_instancing adds to a node. They apply
// before the transform of the node.
std::vector<Affine3d> instance_transforms(const GltfFile& file, const JsonNode& instancing) {
  constexpr std::array<std::pair<std::string_view, std::size_t>, 3> kParts{
      {{"TRANSLATION", 3}, {"ROTATION", 4}, {"SCALE", 3}}};
  const JsonNode attributes = instancing.at("attributes");
  std::optional<std::vector<Affine3d>> transforms;
  for (const auto& [name, components] : kParts) {
    const auto node = attributes.find(name);
    if (!node) continue;
    const GltfAccessor list(file, node->count());
    if (list.components() != components) {
      node->fail_expecting("an accessor of " + std::to_string(components) + " numbers per element");
    }
    // Without stored numbers, a short file could have billions of instances.
    if (!list.range()) node->fail("the accessor has no buffer view; export the file again");
    if (!transforms) transforms.emplace(list.count(), Affine3d::Identity());
    if (transforms->size() != list.count()) {
      node->fail("the accessor has " + std::to_string(list.count()) + " elements, but there are " +
                 std::to_string(transforms->size()) + " instances; export the file again");
    }
    for (std::size_t k = 0; k < list.count(); ++k) {
      Affine3d& transform = (*transforms)[k];
      if (name == "ROTATION") {
        const Eigen::Vector3d xyz = list.vector3(k);
        transform.rotate(unit_quaternion(*node, {xyz.x(), xyz.y(), xyz.z(), list.value(k, 3)}));
      } else if (name == "SCALE") {
        transform.scale(list.vector3(k));
      } else {
        transform.translate(list.vector3(k));
      }
    }
  }
  return transforms.value_or(std::vector{Affine3d(Affine3d::Identity())});
}

std::string name_or_nothing(const JsonNode& node) {
  const auto name = node.find("name");
  return name && name->is_string() ? name->string() : std::string();
}

// Walks the node trees and collects the nodes with a mesh.
class SceneWalk {
 public:
  explicit SceneWalk(const GltfFile& file) : file_(file), root_(file.root()) {
    if (const auto nodes = root_.find("nodes")) nodes_ = nodes->elements();
    if (const auto meshes = root_.find("meshes")) meshes_ = meshes->elements();
    seen_.assign(nodes_.size(), false);
  }

  struct Found {
    GltfObject object;
    std::string node_name;
    std::string mesh_name;
    bool in_scene = false;
  };

  // Returns the names of the scenes, the default scene first.
  std::vector<std::string> scene_names() const {
    std::vector<std::string> names;
    const auto scenes = root_.find("scenes");
    if (!scenes || scenes->elements().empty()) return names;
    for (const JsonNode& scene : scenes->elements()) {
      const std::string name = name_or_nothing(scene);
      names.push_back(name.empty() ? "scene " + std::to_string(names.size()) : name);
    }
    const auto number = root_.find("scene");
    if (number) std::swap(names.front(), names[number_below(*number, names.size())]);
    return names;
  }

  std::vector<Found> run() {
    const std::set<std::size_t> shown = roots_of_scene();
    std::vector<bool> is_child(nodes_.size(), false);
    for (const JsonNode& node : nodes_) {
      for (const std::size_t child : children_of(node)) is_child[child] = true;
    }
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
      if (!is_child[k]) walk(k, Affine3d::Identity(), !has_scene_ || shown.contains(k));
    }
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
      if (!seen_[k]) nodes_[k].fail("this node is its own ancestor; export the file again");
    }
    return std::move(found_);
  }

 private:
  std::size_t number_below(const JsonNode& node, std::size_t count) const {
    const std::size_t k = node.count();
    if (k >= count) {
      node.fail("there is no element " + std::to_string(k) + "; export the file again");
    }
    return k;
  }

  std::vector<std::size_t> numbers_below(const JsonNode& list, std::size_t count) const {
    std::vector<std::size_t> numbers;
    for (const JsonNode& node : list.elements()) numbers.push_back(number_below(node, count));
    return numbers;
  }

  std::vector<std::size_t> children_of(const JsonNode& node) const {
    const auto list = node.find("children");
    return list ? numbers_below(*list, nodes_.size()) : std::vector<std::size_t>();
  }

  std::set<std::size_t> roots_of_scene() {
    const auto scenes = root_.find("scenes");
    if (!scenes || scenes->elements().empty()) return {};
    const std::vector<JsonNode> all = scenes->elements();
    const auto number = root_.find("scene");
    const JsonNode& scene = all[number ? number_below(*number, all.size()) : 0];
    has_scene_ = true;
    const auto roots = scene.find("nodes");
    if (!roots) return {};
    const std::vector<std::size_t> numbers = numbers_below(*roots, nodes_.size());
    return {numbers.begin(), numbers.end()};
  }

  // Not recursive, because untrusted files may have very deep trees.
  void walk(std::size_t root, const Affine3d& transform, bool in_scene) {
    struct Visit {
      std::size_t node;
      Affine3d parent;
    };
    std::vector<Visit> waiting{{root, transform}};
    while (!waiting.empty()) {
      const Visit visit = waiting.back();
      waiting.pop_back();
      const JsonNode& node = nodes_[visit.node];
      if (seen_[visit.node]) node.fail("this node has two parents; export the file again");
      seen_[visit.node] = true;
      const Affine3d to_world = visit.parent * local_transform(node);
      add_objects(visit.node, to_world, in_scene);
      const std::vector<std::size_t> children = children_of(node);
      for (auto child = children.rbegin(); child != children.rend(); ++child) {
        waiting.push_back({*child, to_world});
      }
    }
  }

  void add_objects(std::size_t number, const Affine3d& to_world, bool in_scene) {
    const JsonNode& node = nodes_[number];
    if (!node.has("mesh")) return;
    const auto extensions = node.find("extensions");
    const auto instancing = extensions ? extensions->find(kInstancingExtension) : std::nullopt;
    // The joints of a skin place the mesh, so it has no instances.
    if (!instancing || node.has("skin")) return add_object(number, to_world, in_scene, {});
    const std::vector<Affine3d> instances = instance_transforms(file_, *instancing);
    for (std::size_t k = 0; k < instances.size(); ++k) {
      const std::string suffix = " (instance " + std::to_string(k) + ")";
      add_object(number, to_world * instances[k], in_scene, suffix);
      found_.back().object.is_instance = instances.size() > 1;
    }
  }

  // `suffix` is appended to the name of the node.
  void add_object(std::size_t number, const Affine3d& to_world, bool in_scene,
                  const std::string& suffix) {
    const JsonNode& node = nodes_[number];
    Found found;
    found.in_scene = in_scene;
    found.object.node = number;
    found.object.mesh = number_below(node.at("mesh"), meshes_.size());
    found.object.has_skin = node.has("skin");
    if (!found.object.has_skin) found.object.to_world = to_world;
    found.mesh_name = name_or_nothing(meshes_[found.object.mesh]);
    found.node_name = name_or_nothing(node);
    const std::string& name = found.node_name.empty() ? found.mesh_name : found.node_name;
    const std::string numbered = "node " + std::to_string(number);
    found.object.name = (name.empty() ? numbered : name) + suffix;
    // Several objects may have the same name, for example unnamed nodes that show the same mesh.
    // The number of the node makes the name unique.
    if (!names_.insert(found.object.name).second) found.object.name += " (" + numbered + ")";
    found_.push_back(std::move(found));
  }

  const GltfFile& file_;
  const JsonNode& root_;
  std::vector<JsonNode> nodes_;
  std::vector<JsonNode> meshes_;
  std::vector<bool> seen_;
  bool has_scene_ = false;
  std::set<std::string> names_;
  std::vector<Found> found_;
};

// Removes the objects with a scale of 0, whose transforms have no inverse, and adds a note about
// them. Throws InputError if no object is left.
void leave_out_collapsed(const GltfFile& file, std::vector<GltfObject>& objects,
                         std::vector<std::string>& notes) {
  const std::string path = file.source().path().string();
  std::vector<std::string> names;
  for (const GltfObject& object : objects) {
    const double determinant = object.to_world.linear().determinant();
    if (!std::isfinite(determinant)) {
      throw InputError(path + ": the object '" + object.name +
                       "' has a scale that is not finite; give its node, and the nodes above it, a "
                       "finite scale");
    }
    if (determinant == 0.0) names.push_back(object.name);
  }
  if (names.empty()) return;
  std::erase_if(objects, [](const GltfObject& object) {
    return object.to_world.linear().determinant() == 0.0;
  });
  const bool is_one = names.size() == 1;
  const std::string what = path + ": " + quoted_list(names) + (is_one ? " has" : " have") +
                           " a scale of 0 and thus no surface";
  const std::string next = "; to edit " + std::string(is_one ? "it" : "them") +
                           ", choose another scale for the node and the nodes above it";
  if (objects.empty()) throw InputError(what + next);
  notes.push_back(what + ", so " + (is_one ? "it is" : "they are") + " left out" + next);
}

void note_outside_scene(const GltfFile& file, const std::vector<std::string>& scenes,
                        const std::vector<SceneWalk::Found>& all, std::vector<std::string>& notes) {
  std::vector<std::string> outside;
  for (const SceneWalk::Found& found : all) {
    if (!found.in_scene) outside.push_back(found.object.name);
  }
  if (outside.empty()) return;
  const std::filesystem::path& path = file.source().path();
  std::string note = path.string() + ": only the scene '" + scenes.front() + "' is read";
  if (scenes.size() > 1) note += ", not " + quoted_list(std::span(scenes).subspan(1));
  notes.push_back(note + ", so " + quoted_list(outside) + (outside.size() == 1 ? " is" : " are") +
                  " left out; to read an object outside the scene, name it: " +
                  path.filename().string() + "#" + outside.front());
}

[[noreturn]] void fail_unknown(const GltfFile& file, const std::string& name,
                               const std::vector<SceneWalk::Found>& all) {
  constexpr std::size_t kMostTold = 20;
  std::vector<std::string_view> known;
  for (const SceneWalk::Found& found : all) {
    if (known.size() < kMostTold) known.push_back(found.object.name);
  }
  throw InputError(file.source().path().string() + ": there is no object '" + name +
                   "' with a mesh" +
                   (known.empty() ? "; the file has no meshes" : "; " + suggest(name, known)));
}

}  // namespace

std::vector<GltfObject> find_objects(const GltfFile& file, const std::string& name,
                                     std::vector<std::string>& notes) {
  SceneWalk walk(file);
  const std::vector<SceneWalk::Found> all = walk.run();
  const auto choose = [&all](const auto& is_chosen) {
    std::vector<GltfObject> chosen;
    for (const SceneWalk::Found& found : all) {
      if (is_chosen(found)) chosen.push_back(found.object);
    }
    return chosen;
  };
  std::vector<GltfObject> chosen;
  if (name.empty()) {
    chosen = choose([](const SceneWalk::Found& found) { return found.in_scene; });
    note_outside_scene(file, walk.scene_names(), all, notes);
  } else {
    chosen = choose([&](const SceneWalk::Found& found) {
      return found.node_name == name || found.object.name == name;
    });
    if (chosen.empty()) {
      chosen = choose([&](const SceneWalk::Found& found) { return found.mesh_name == name; });
    }
    if (chosen.empty()) fail_unknown(file, name, all);
  }
  leave_out_collapsed(file, chosen, notes);
  return chosen;
}

std::vector<std::string> objects_showing(const GltfFile& file, std::size_t mesh) {
  std::vector<std::string> names;
  for (const SceneWalk::Found& found : SceneWalk(file).run()) {
    if (found.object.mesh == mesh) names.push_back(found.object.name);
  }
  return names;
}

}  // namespace lapwing
