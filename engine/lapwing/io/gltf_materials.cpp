#include "lapwing/io/gltf_materials.h"

#include "lapwing/base/srgb.h"
#include "lapwing/io/gltf_file.h"
#include "lapwing/io/uri.h"

namespace lapwing {
namespace {

// Returns the element of `list` whose index is `node`, if both exist.
std::optional<JsonNode> numbered(const JsonNode& root, const char* list,
                                 const std::optional<JsonNode>& node) {
  const auto all = node ? root.find(list) : std::nullopt;
  return all ? all->element(node->count()) : std::nullopt;
}

// Returns the path of a texture's image; empty if there is none or it is embedded.
std::string image_of(const JsonNode& root, const JsonNode& texture, bool& is_inside) {
  const auto found = numbered(root, "textures", texture.find("index"));
  const auto image = found ? numbered(root, "images", found->find("source")) : std::nullopt;
  if (!image) return {};
  const auto uri = image->find("uri");
  is_inside = !uri || uri->string().starts_with("data:");
  return is_inside ? std::string() : path_of_uri(uri->string());
}

}  // namespace

std::vector<Material> read_gltf_materials(const std::filesystem::path& path,
                                          std::vector<std::string>& notes) {
  MeshPath name = split_mesh_path(path);
  const MeshFormat format = format_of(name.file);
  const SourceFile source(std::move(name), format);
  const GltfFile file(source);
  std::vector<Material> materials;
  bool any_inside = false;
  const auto list = file.root().find("materials");
  if (!list) return materials;
  for (const JsonNode& node : list->elements()) {
    Material& material = materials.emplace_back();
    material.name = gltf_material_name(node, materials.size() - 1);
    const auto surface = node.find("pbrMetallicRoughness");
    if (!surface) continue;
    Eigen::Vector3f color = Eigen::Vector3f::Ones();
    if (const auto factor = surface->find("baseColorFactor")) {
      const std::vector<double> numbers = factor->numbers();
      for (std::size_t c = 0; c < 3 && c < numbers.size(); ++c) {
        color[static_cast<Eigen::Index>(c)] = srgb_of_linear(static_cast<float>(numbers[c]));
      }
    }
    material.color = color;
    if (const auto texture = surface->find("baseColorTexture")) {
      bool is_inside = false;
      material.image = image_of(file.root(), *texture, is_inside);
      any_inside = any_inside || is_inside;
    }
  }
  if (any_inside) {
    notes.push_back(source.path().string() +
                    ": the images embedded in the file are not shown; they remain in the file");
  }
  return materials;
}

}  // namespace lapwing
