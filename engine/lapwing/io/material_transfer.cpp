#include "lapwing/io/material_transfer.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <system_error>

#include "lapwing/base/errors.h"
#include "lapwing/base/srgb.h"
#include "lapwing/io/file_bytes.h"
#include "lapwing/io/gltf_file.h"
#include "lapwing/io/image.h"
#include "lapwing/io/mesh_materials.h"
#include "lapwing/io/paths.h"
#include "lapwing/io/uri.h"
#include "lapwing/io/writing.h"

namespace lapwing {
namespace {

namespace fs = std::filesystem;

// Returns the index in `images` of a material's image, or kNoIndex. Adds the image if it is new.
Index number_of_image(const FoundMaterial& found, const fs::path& mesh,
                      std::vector<MaterialTransfer::ImageFile>& images, WriteReport& report) {
  const Material& material = found.material;
  if (material.image.empty()) return kNoIndex;
  MaterialTransfer::ImageFile image{.name = material.image};
  if (material.embedded_image) {
    image.bytes = material.embedded_image;
  } else {
    image.path = find_image(material.image, found.file, mesh, report.notes);
    if (!image.path) return kNoIndex;
    image.name = image.path->filename().string();
  }
  const auto same = std::ranges::find_if(images, [&](const MaterialTransfer::ImageFile& other) {
    return other.path == image.path && (image.path || other.bytes == image.bytes);
  });
  if (same != images.end()) return static_cast<Index>(same - images.begin());
  if (image.path) {
    try {
      image.bytes = std::make_shared<const std::string>(FileBytes::read_data(*image.path).view());
    } catch (const Error& error) {
      report.notes.emplace_back(error.what());
      return kNoIndex;
    }
  }
  images.push_back(std::move(image));
  return static_cast<Index>(images.size() - 1);
}

FoundMaterial texture(const std::string& name, const fs::path& mesh) {
  return {{.name = name, .color = Eigen::Vector3f::Ones(), .image = name}, mesh};
}

void erase_texture_numbers(MeshAttributes& attributes) {
  std::erase_if(attributes.face_extras,
                [](const ExtraAttribute& extra) { return extra.name == kTextureNumber; });
}

}  // namespace

MaterialTransfer read_materials(const Mesh& mesh, const fs::path& path, WriteReport& report) {
  MaterialTransfer transfer;
  std::vector<std::string> names = mesh.attributes().materials;
  const bool has_textures = names.empty();
  if (has_textures) names = texture_names(mesh.attributes());
  if (names.empty()) return transfer;
  std::vector<std::optional<FoundMaterial>> found(names.size());
  if (path.empty()) {
    report.not_carried.push_back("colours and images of materials (" + grouped(names.size()) +
                                 "): the source file of the mesh is unknown");
  } else if (has_textures) {
    for (std::size_t m = 0; m < names.size(); ++m) found[m] = texture(names[m], path);
  } else {
    found = find_materials(mesh, path, report.notes);
  }
  std::size_t further_images = 0;
  std::size_t images_without_uvs = 0;
  for (std::size_t m = 0; m < names.size(); ++m) {
    MaterialTransfer::Entry& entry = transfer.entries.emplace_back();
    if (const std::optional<FoundMaterial>& material = found[m]) {
      entry.material = material->material;
      further_images += entry.material.further_images;
      if (mesh.attributes().corner_uvs.empty()) {
        images_without_uvs += entry.material.image.empty() ? 0 : 1;
      } else {
        entry.image = number_of_image(*material, path, transfer.images, report);
      }
    }
    entry.material.name = names[m];
  }
  if (images_without_uvs > 0) {
    report.not_carried.push_back("images of materials (" + std::to_string(images_without_uvs) +
                                 "): the mesh has no texture coordinates to show them");
  }
  if (further_images > 0) {
    report.not_carried.push_back("images of materials other than map_Kd (" +
                                 std::to_string(further_images) +
                                 "): only colours and their images are converted");
  }
  return transfer;
}

namespace {

bool has_content(const fs::path& path, std::string_view bytes) {
  std::error_code error;
  if (fs::file_size(path, error) != bytes.size() || error) return false;
  return FileBytes::read(path).view() == bytes;
}

// Returns the path of an image relative to the folder of `target`. Adds the image to `files` unless
// that folder already contains it.
std::string place_image(const MaterialTransfer::ImageFile& image, const fs::path& target,
                        std::vector<FileContent>& files) {
  const fs::path folder = target.parent_path();
  const fs::path here = folder.empty() ? fs::path(".") : folder;
  if (image.path && is_inside(*image.path, here)) {
    return real_path(*image.path)
        .lexically_relative(real_path(here / ".").parent_path())
        .generic_string();
  }
  const fs::path wanted(image.name);
  for (std::size_t serial = 0;; ++serial) {
    const std::string name = wanted.stem().string() +
                             (serial > 0 ? "-" + std::to_string(serial) : "") +
                             wanted.extension().string();
    const fs::path path = folder / name;
    const auto same = std::ranges::find(files, path, &FileContent::path);
    if (same != files.end()) {
      if (same->bytes == *image.bytes) return name;
      continue;
    }
    std::error_code error;
    if (!fs::exists(path, error)) {
      files.push_back({path, *image.bytes});
      return name;
    }
    if (has_content(path, *image.bytes)) return name;
  }
}

// Returns the number of each face's texture, or -1.
std::vector<double> texture_numbers(const MaterialTransfer& materials, const Mesh& mesh) {
  std::vector<double> numbers(mesh.face_count(), -1.0);
  const std::vector<Index>& of_face = mesh.attributes().face_materials;
  for (std::size_t f = 0; f < of_face.size(); ++f) {
    const Index image = of_face[f] == kNoIndex ? kNoIndex : materials.entries[of_face[f]].image;
    if (image != kNoIndex) numbers[f] = image;
  }
  return numbers;
}

}  // namespace

Mesh with_texture_materials(const Mesh& mesh) {
  std::vector<std::string> names = texture_names(mesh.attributes());
  if (names.empty() || !mesh.attributes().materials.empty()) return mesh;
  Mesh result = mesh;
  MeshAttributes& a = result.edit_attributes();
  a.face_materials = textures_of_faces(mesh, names.size());
  a.materials = std::move(names);
  std::erase_if(a.comments, [](const std::string& c) { return c.starts_with(kTextureComment); });
  erase_texture_numbers(a);
  return result;
}

std::vector<FileContent> add_ply_textures(const MaterialTransfer& materials, const fs::path& target,
                                          Mesh& mesh, WriteReport& report) {
  std::vector<double> numbers = texture_numbers(materials, mesh);
  MeshAttributes& a = mesh.edit_attributes();
  std::vector<FileContent> files;
  for (const MaterialTransfer::ImageFile& image : materials.images) {
    a.comments.push_back(std::string(kTextureComment) + place_image(image, target, files));
  }
  erase_texture_numbers(a);
  // Without numbers, all faces have the first texture.
  const bool all_have_first = std::ranges::count(numbers, 0.0) == std::ssize(numbers);
  if (!materials.images.empty() && !all_have_first) {
    a.face_extras.push_back({std::string(kTextureNumber), "int", 1, std::move(numbers)});
  }
  const auto has_placed_image = [](const MaterialTransfer::Entry& entry) {
    return entry.image != kNoIndex && (entry.material.uv_scale != Eigen::Vector2d::Ones() ||
                                       entry.material.uv_offset != Eigen::Vector2d::Zero());
  };
  report_loss(report, MeshFormat::ply, "names and colours of materials", a.materials.size());
  report_loss(report, MeshFormat::ply, "scales and offsets of images",
              static_cast<std::size_t>(std::ranges::count_if(materials.entries, has_placed_image)));
  a.materials.clear();
  a.face_materials.clear();
  return files;
}

namespace {

void append_pair(std::string& out, std::string_view option, const Eigen::Vector2d& pair) {
  out += option;
  append_numbers(out, pair);
}

}  // namespace

std::vector<FileContent> mtl_files(const MaterialTransfer& materials, const fs::path& target) {
  fs::path library = target;
  library.replace_extension(".mtl");
  std::vector<FileContent> files{{library, {}}};
  std::string text = "# Lapwing\n";
  for (const MaterialTransfer::Entry& entry : materials.entries) {
    const Material& material = entry.material;
    text += "\nnewmtl " + as_line(material.name) + "\n";
    if (material.color) {
      // Six digits hide the rounding errors of converting to linear light and back.
      std::array<char, 64> line{};
      std::snprintf(line.data(), line.size(), "Kd %.6g %.6g %.6g\n", double{material.color->x()},
                    double{material.color->y()}, double{material.color->z()});
      text += line.data();
    }
    if (material.opacity != 1.0F) {
      text += "d ";
      append_number(text, material.opacity);
      text += '\n';
    }
    if (entry.image == kNoIndex) continue;
    text += "map_Kd";
    if (material.uv_scale != Eigen::Vector2d::Ones()) append_pair(text, " -s", material.uv_scale);
    if (material.uv_offset != Eigen::Vector2d::Zero()) append_pair(text, " -o", material.uv_offset);
    if (material.is_clamped) text += " -clamp on";
    text += " " + as_line(place_image(materials.images[entry.image], target, files)) + "\n";
  }
  files.front().bytes = std::move(text);
  return files;
}

namespace {

void append_json(std::string& list, const std::string& element) {
  if (!list.empty()) list += ',';
  list += element;
}

std::string json_pair(double x, double y) {
  std::string json = "[";
  append_number(json, x);
  json += ',';
  append_number(json, y);
  return json + "]";
}

// Writes the materials, textures and images of a new glTF document.
class GltfMaterialWriter {
 public:
  GltfMaterialWriter(const MaterialTransfer& materials, const fs::path& target,
                     GltfAppender& appender, WriteReport& report)
      : materials_(materials),
        target_(target),
        appender_(appender),
        report_(report),
        number_of_image_(materials.images.size(), kUnknown) {}

  GltfMaterials write() {
    std::string list;
    for (const MaterialTransfer::Entry& entry : materials_.entries) {
      append_json(list, material(entry));
    }
    GltfMaterials result{.json = R"("materials":[)" + list + "]", .files = std::move(files_)};
    if (has_clamped_) {
      const std::string mode = std::to_string(kGltfClampToEdge);
      result.json += R"(,"samplers":[{"wrapS":)" + mode + R"(,"wrapT":)" + mode + "}]";
    }
    if (!images_.empty()) {
      result.json += R"(,"textures":[)" + textures_ + R"(],"images":[)" + images_ + "]";
    }
    if (has_transform_) result.json += R"(,"extensionsUsed":["KHR_texture_transform"])";
    return result;
  }

 private:
  static constexpr Index kUnknown = kNoIndex - 1;

  std::string material(const MaterialTransfer::Entry& entry) {
    const Material& from = entry.material;
    std::string json = R"({"name":)" + quoted_json(from.name);
    const Index texture = entry.image == kNoIndex ? kNoIndex : texture_of(entry);
    if (!from.color && from.opacity == 1.0F && texture == kNoIndex) return json + "}";
    // Some programs write Kd 0 0 0 for a material with an image, but show the image unchanged.
    const bool is_black = from.color && from.color->isZero();
    const Eigen::Vector3f color =
        !from.color || (texture != kNoIndex && is_black) ? Eigen::Vector3f(1, 1, 1) : *from.color;
    json += R"(,"pbrMetallicRoughness":{"baseColorFactor":[)";
    for (const float c : color) {
      append_number(json, linear_of_srgb(c));
      json += ',';
    }
    append_number(json, from.opacity);
    json += R"(],"metallicFactor":0)";
    if (texture != kNoIndex) {
      json += R"(,"baseColorTexture":{"index":)" + std::to_string(texture) + transform(from) + "}";
    }
    json += '}';
    if (from.opacity != 1.0F) json += R"(,"alphaMode":"BLEND")";
    return json + "}";
  }

  // In glTF v runs downwards.
  std::string transform(const Material& material) {
    const Eigen::Vector2d& scale = material.uv_scale;
    const Eigen::Vector2d& offset = material.uv_offset;
    if (scale == Eigen::Vector2d::Ones() && offset == Eigen::Vector2d::Zero()) return {};
    has_transform_ = true;
    return R"(,"extensions":{"KHR_texture_transform":{"offset":)" +
           json_pair(offset.x(), 1.0 - scale.y() - offset.y()) + R"(,"scale":)" +
           json_pair(scale.x(), scale.y()) + "}}";
  }

  // Returns the index of the texture of a material, or kNoIndex if its image cannot be read.
  Index texture_of(const MaterialTransfer::Entry& entry) {
    const Index image = number_of_image(entry.image);
    if (image == kNoIndex) return kNoIndex;
    const bool is_clamped = entry.material.is_clamped;
    const auto [known, is_new] = texture_of_.try_emplace(std::pair(image, is_clamped),
                                                         static_cast<Index>(texture_of_.size()));
    if (is_new) {
      append_json(textures_, R"({"source":)" + std::to_string(image) +
                                 (is_clamped ? R"(,"sampler":0})" : "}"));
      has_clamped_ = has_clamped_ || is_clamped;
    }
    return known->second;
  }

  // Returns the index that an image gets in the file, or kNoIndex if it cannot be read.
  Index number_of_image(Index image) {
    Index& number = number_of_image_[image];
    if (number != kUnknown) return number;
    number = kNoIndex;
    try {
      add_image(as_png_or_jpeg(materials_.images[image]));
    } catch (const InputError& error) {
      report_.not_carried.push_back("an image of a material: " + std::string(error.what()));
      return number;
    }
    return number = image_count_++;
  }

  static MaterialTransfer::ImageFile as_png_or_jpeg(const MaterialTransfer::ImageFile& image) {
    const std::string_view extension = image_extension(*image.bytes);
    if (extension == ".png" || extension == ".jpg") return image;
    const std::string shown = image.path ? image.path->string() : image.name;
    return {.name = fs::path(image.name).stem().string() + ".png",
            .bytes =
                std::make_shared<const std::string>(encode_png(decode_image(*image.bytes, shown)))};
  }

  void add_image(const MaterialTransfer::ImageFile& image) {
    const std::string name = quoted_json(fs::path(image.name).stem().string());
    if (format_of(target_) == MeshFormat::gltf) {
      const std::string path = place_image(image, target_, files_);
      append_json(images_, R"({"name":)" + name + R"(,"uri":")" + uri_of_path(path) + "\"}");
      return;
    }
    const std::size_t view = appender_.add_view(*image.bytes, GltfAppender::Target::none);
    const bool is_png = image_extension(*image.bytes) == ".png";
    append_json(images_, R"({"name":)" + name + R"(,"bufferView":)" + std::to_string(view) +
                             R"(,"mimeType":"image/)" + (is_png ? "png" : "jpeg") + "\"}");
  }

  const MaterialTransfer& materials_;
  const fs::path& target_;
  GltfAppender& appender_;
  WriteReport& report_;
  std::vector<Index> number_of_image_;
  Index image_count_ = 0;
  std::map<std::pair<Index, bool>, Index> texture_of_;  // by index of the image and is_clamped
  bool has_clamped_ = false;
  std::string textures_;
  std::string images_;
  bool has_transform_ = false;
  std::vector<FileContent> files_;
};

}  // namespace

GltfMaterials gltf_materials(const MaterialTransfer& materials, const fs::path& target,
                             GltfAppender& appender, WriteReport& report) {
  if (materials.entries.empty()) return {};
  return GltfMaterialWriter(materials, target, appender, report).write();
}

}  // namespace lapwing
