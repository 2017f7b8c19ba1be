#include "lapwing/io/gltf_instances.h"

#include <algorithm>
#include <map>
#include <set>

#include "lapwing/base/errors.h"
#include "lapwing/base/printable_text.h"
#include "lapwing/io/source_file.h"

namespace lapwing {
namespace {

// Two positions are equal up to rounding if they differ by less than this fraction of the mesh's
// size.
constexpr double kRounding = 1e-6;

class InstanceComparison {
 public:
  InstanceComparison(const GltfLayout& layout, const Mesh& mesh)
      : layout_(layout), mesh_(mesh), sets_of_(layout.objects.size()) {
    for (const GltfRecords& set : layout.records) sets_of_[set.object].push_back(&set);
  }

  bool has_moved(std::size_t object) const {
    return std::ranges::any_of(sets_of_[object], [&](const GltfRecords* set) {
      for (std::size_t k = 0; k < set->count(); ++k) {
        if (!are_same(layout_.position(*set, k), now(*set, k))) return true;
      }
      return false;
    });
  }

  // The objects must show the same mesh, so that their record sets correspond.
  bool are_alike(std::size_t a, std::size_t b) const {
    const Eigen::Affine3d from_a = layout_.objects[a].to_world.inverse();
    const Eigen::Affine3d from_b = layout_.objects[b].to_world.inverse();
    Positions of_a;
    Positions of_b;
    for (std::size_t s = 0; s < sets_of_[a].size(); ++s) {
      for (std::size_t k = 0; k < sets_of_[a][s]->count(); ++k) {
        of_a.push_back(from_a * now(*sets_of_[a][s], k));
        of_b.push_back(from_b * now(*sets_of_[b][s], k));
      }
    }
    const double tolerance = kRounding * bounds_of(of_a).diagonal();
    for (std::size_t k = 0; k < of_a.size(); ++k) {
      if (!are_same(of_a[k], of_b[k]) && !((of_a[k] - of_b[k]).norm() <= tolerance)) return false;
    }
    return true;
  }

 private:
  const Eigen::Vector3d& now(const GltfRecords& set, std::size_t k) const {
    return mesh_.positions[layout_.vertex_of_record[set.first_record + k]];
  }

  const GltfLayout& layout_;
  const Mesh& mesh_;
  std::vector<std::vector<const GltfRecords*>> sets_of_;
};

}  // namespace

std::vector<MovedInstances> moved_instances(const GltfLayout& layout, const Mesh& mesh) {
  std::map<std::size_t, std::vector<std::size_t>> objects_of;  // key: index of the mesh
  for (std::size_t k = 0; k < layout.objects.size(); ++k) {
    objects_of[layout.objects[k].mesh].push_back(k);
  }
  std::vector<MovedInstances> all;
  const InstanceComparison comparison(layout, mesh);
  for (auto& [number, objects] : objects_of) {
    MovedInstances instances{.objects = std::move(objects), .moved = {}};
    std::ranges::copy_if(instances.objects, std::back_inserter(instances.moved),
                         [&](std::size_t object) { return comparison.has_moved(object); });
    if (instances.moved.empty()) continue;
    instances.are_alike = std::ranges::all_of(instances.moved, [&](std::size_t object) {
      return object == instances.moved.front() ||
             comparison.are_alike(instances.moved.front(), object);
    });
    all.push_back(std::move(instances));
  }
  return all;
}

std::vector<std::string> others_showing(const GltfLayout& layout,
                                        const std::vector<std::size_t>& edited) {
  std::vector<std::string> names =
      objects_showing(layout.file, layout.objects[edited.front()].mesh);
  std::set<std::string_view> own;
  for (const std::size_t object : edited) own.insert(layout.objects[object].name);
  std::erase_if(names, [&](const std::string& name) { return own.contains(name); });
  return names;
}

void require_own_node(const GltfObject& object) {
  if (!object.is_instance) return;
  throw InputError(
      "'" + object.name +
      "' is an instance of a node (EXT_mesh_gpu_instancing) and cannot differ from the "
      "other instances; edit one instance, which changes all of them, or save another "
      "format");
}

std::string names_of(const GltfLayout& layout, const std::vector<std::size_t>& objects) {
  std::vector<std::string> names;
  for (const std::size_t object : objects) names.push_back(layout.objects[object].name);
  return quoted_list(names);
}

std::string note_of_shared_edit(const GltfLayout& layout, const std::vector<std::size_t>& edited,
                                const std::vector<std::string>& others) {
  return "the mesh of " + names_of(layout, edited) + " is also shown by " + quoted_list(others) +
         ", where the edit appears too; to edit one alone, give it its own mesh first";
}

std::string note_of_separation(const GltfLayout& layout, const std::vector<std::size_t>& edited) {
  return names_of(layout, edited) +
         " showed one mesh but were edited differently; each has its own mesh now";
}

}  // namespace lapwing
