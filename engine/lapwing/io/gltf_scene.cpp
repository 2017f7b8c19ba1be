#include "lapwing/io/gltf_scene.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "lapwing/base/errors.h"
#include "lapwing/json/suggest.h"

namespace lapwing {
namespace {

using Eigen::Affine3d;

std::vector<double> numbers_at(const JsonNode& node, std::size_t count) {
  std::vector<double> numbers = node.numbers();
  if (numbers.size() != count) node.fail_expecting(std::to_string(count) + " numbers");
  return numbers;
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
    const Eigen::Quaterniond rotation(q[3], q[0], q[1], q[2]);
    if (!(rotation.norm() > 0.0)) turn->fail("expected a quaternion other than 0");
    transform.rotate(rotation.normalized());
  }
  if (const auto factor = node.find("scale")) {
    const std::vector<double> s = numbers_at(*factor, 3);
    transform.scale(Eigen::Vector3d(s[0], s[1], s[2]));
  }
  return transform;
}

std::string name_or_nothing(const JsonNode& node) {
  const auto name = node.find("name");
  return name && name->is_string() ? name->string() : std::string();
}

// Walks the node trees and collects the nodes with a mesh.
class SceneWalk {
 public:
  explicit SceneWalk(const GltfFile& file) : root_(file.root()) {
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
      note(visit.node, to_world, in_scene);
      const std::vector<std::size_t> children = children_of(node);
      for (auto child = children.rbegin(); child != children.rend(); ++child) {
        waiting.push_back({*child, to_world});
      }
    }
  }

  void note(std::size_t number, const Affine3d& to_world, bool in_scene) {
    const JsonNode& node = nodes_[number];
    const auto mesh = node.find("mesh");
    if (!mesh) return;
    Found found;
    found.in_scene = in_scene;
    found.object.node = number;
    found.object.mesh = number_below(*mesh, meshes_.size());
    found.object.has_skin = node.has("skin");
    if (!found.object.has_skin) found.object.to_world = to_world;
    found.mesh_name = name_or_nothing(meshes_[found.object.mesh]);
    found.node_name = name_or_nothing(node);
    const std::string& name = found.node_name.empty() ? found.mesh_name : found.node_name;
    const std::string numbered = "node " + std::to_string(number);
    found.object.name = name.empty() ? numbered : name;
    // Several objects may have the same name, for example unnamed nodes that show the same mesh.
    // The number of the node makes the name unique.
    if (!names_.insert(found.object.name).second) {
      found.object.name = name + " (" + numbered + ")";
    }
    found_.push_back(std::move(found));
  }

  const JsonNode& root_;
  std::vector<JsonNode> nodes_;
  std::vector<JsonNode> meshes_;
  std::vector<bool> seen_;
  bool has_scene_ = false;
  std::set<std::string> names_;
  std::vector<Found> found_;
};

void require_invertible(const GltfFile& file, const GltfObject& object) {
  const double determinant = object.to_world.linear().determinant();
  if (std::isfinite(determinant) && determinant != 0.0) return;
  throw InputError(file.source().path().string() + ": the object '" + object.name +
                   "' has a scale that is zero or not finite; give its node, and the nodes above "
                   "it, a finite scale other than 0");
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

std::vector<GltfObject> find_objects(const GltfFile& file, const std::string& name) {
  const std::vector<SceneWalk::Found> all = SceneWalk(file).run();
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
  } else {
    chosen = choose([&](const SceneWalk::Found& found) {
      return found.node_name == name || found.object.name == name;
    });
    if (chosen.empty()) {
      chosen = choose([&](const SceneWalk::Found& found) { return found.mesh_name == name; });
    }
    if (chosen.empty()) fail_unknown(file, name, all);
  }
  for (const GltfObject& object : chosen) require_invertible(file, object);
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
