#include "lapwing/io/file_colors.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>
#include <utility>

#include "lapwing/base/errors.h"
#include "lapwing/base/grouped.h"
#include "lapwing/io/gltf_materials.h"
#include "lapwing/io/material_library.h"
#include "lapwing/io/named_file.h"
#include "lapwing/io/reading.h"

namespace lapwing {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostImages = 1024;
// 32-bit words in 128 MiB, less 256 KiB for the table of mip levels.
constexpr std::uint64_t kMostTexels = (std::uint64_t{1} << 25U) - (std::uint64_t{1} << 16U);
constexpr std::size_t kMostNotes = 20;
constexpr std::string_view kTextureComment = "TextureFile ";

// Counts the texels of all mip levels.
std::uint64_t texels_of(ImageSize size) {
  std::uint64_t texels = std::uint64_t{size.width} * size.height;
  while (size.width > 1 || size.height > 1) {
    size = halved(size);
    texels += std::uint64_t{size.width} * size.height;
  }
  return texels;
}

// The images that materials name. Each is read once, even if several materials name it.
class ImageCache {
 public:
  explicit ImageCache(std::vector<std::string>& notes) : notes_(notes) {}

  /// Returns the index of the image `name` that the file `namer` refers to, or kNoIndex if it is
  /// not found. Searches beside `namer`, then beside the mesh.
  Index add(const std::string& name, const fs::path& namer, const fs::path& mesh) {
    const auto [known, is_new] = by_name_.try_emplace({namer, name}, kNoIndex);
    if (!is_new) return known->second;
    std::optional<fs::path> path = find_named_file(namer.parent_path(), name);
    if (!path) path = find_named_file(mesh.parent_path(), name);
    if (!path) {
      notes_.push_back("image '" + name + "' is not beside " + namer.string() + "; put it there");
    } else {
      known->second = add_file(*path);
    }
    return known->second;
  }

  /// Reads all images, halved until they fit. An unreadable image has no pixels.
  std::vector<Image> read() {
    fit();
    std::vector<Image> images(files_.size());
    for (std::size_t i = 0; i < files_.size(); ++i) {
      try {
        images[i] = read_image(files_[i].path);
        for (int h = 0; h < files_[i].halvings; ++h) images[i] = halved(images[i]);
      } catch (const Error& error) {
        notes_.emplace_back(error.what());
        images[i] = {};
      }
    }
    return images;
  }

 private:
  struct File {
    fs::path path;
    ImageSize size;  ///< after the halvings
    int halvings = 0;
  };

  Index add_file(const fs::path& path) {
    const auto same = std::ranges::find(files_, path, &File::path);
    if (same != files_.end()) return static_cast<Index>(same - files_.begin());
    if (files_.size() == kMostImages) {
      notes_.push_back(path.string() + ": the image is not shown, because there are more than " +
                       grouped(kMostImages) + " images; combine some of them");
      return kNoIndex;
    }
    try {
      files_.push_back({path, read_image_size(path)});
      return static_cast<Index>(files_.size() - 1);
    } catch (const Error& error) {
      notes_.emplace_back(error.what());
      return kNoIndex;
    }
  }

  void fit() {
    std::uint64_t texels = 0;
    for (const File& file : files_) texels += texels_of(file.size);
    const bool fits = texels <= kMostTexels;
    while (texels > kMostTexels) {
      File& largest = *std::ranges::max_element(
          files_, {}, [](const File& file) { return texels_of(file.size); });
      texels -= texels_of(largest.size);
      largest.size = halved(largest.size);
      ++largest.halvings;
      texels += texels_of(largest.size);
    }
    if (!fits) {
      notes_.emplace_back(
          "the images take more than 128 MiB together; the largest are shown with fewer pixels");
    }
  }

  std::vector<std::string>& notes_;
  std::map<std::pair<fs::path, std::string>, Index> by_name_;
  std::vector<File> files_;
};

class FileColorReader {
 public:
  FileColorReader(const Mesh& mesh, const fs::path& path)
      : mesh_(mesh), attributes_(mesh.attributes()), path_(path) {}

  FileColors read() {
    if (!attributes_.materials.empty() || !attributes_.material_libraries.empty()) {
      read_libraries();
      take_materials();
    } else {
      take_textures();
    }
    take_images();
    check_corners();
    if (notes_.size() > kMostNotes) {
      const std::size_t more = notes_.size() - kMostNotes;
      notes_.resize(kMostNotes);
      notes_.push_back("and " + grouped(more) + " more like these");
    }
    colors_.notes = std::move(notes_);
    return std::move(colors_);
  }

 private:
  struct Known {
    Material material;
    fs::path library;
  };

  void read_libraries() {
    if (is_gltf(format_of(split_mesh_path(path_).file))) return add_materials_of_gltf();
    for (const std::string& names : attributes_.material_libraries) {
      // The line may be one name with blanks, or several names.
      if (read_library(names)) continue;
      bool found = false;
      for (std::size_t at = 0; at < names.size();) {
        const std::size_t end = std::min(names.find(' ', at), names.size());
        if (end > at) found = read_library(names.substr(at, end - at)) || found;
        at = end + 1;
      }
      if (!found && !attributes_.materials.empty()) read_library_of_same_name(names);
    }
    if (attributes_.material_libraries.empty()) {
      notes_.push_back(path_.string() +
                       " names materials but no library (mtllib); export it again with one");
    }
  }

  void add_materials_of_gltf() {
    try {
      for (Material& material : read_gltf_materials(path_, notes_)) {
        std::string name = material.name;
        known_.try_emplace(std::move(name), Known{std::move(material), path_});
      }
    } catch (const Error& error) {
      notes_.emplace_back(error.what());
    }
  }

  bool read_library(const std::string& name) {
    const auto path = find_named_file(path_.parent_path(), name);
    if (path) add_library(*path);
    return path.has_value();
  }

  void read_library_of_same_name(const std::string& missing) {
    const std::string own = path_.stem().string() + ".mtl";
    std::string note =
        "material library '" + missing + "' is not beside " + path_.string() + "; put it there";
    if (read_library(own)) note += " (" + own + " was read in its place)";
    notes_.push_back(std::move(note));
  }

  void add_library(const fs::path& path) {
    try {
      for (Material& material : read_material_library(path, notes_)) {
        std::string name = material.name;
        known_.try_emplace(std::move(name), Known{std::move(material), path});
      }
    } catch (const Error& error) {
      notes_.emplace_back(error.what());
    }
  }

  void take_materials() {
    if (attributes_.materials.empty() && !known_.empty()) {
      notes_.push_back(path_.string() +
                       " does not assign materials of its library to faces (usemtl); export it "
                       "again with them");
    }
    std::vector<char> has_faces(attributes_.materials.size(), 0);
    for (const Index material : attributes_.face_materials) {
      if (material != kNoIndex) has_faces[material] = 1;
    }
    for (std::size_t m = 0; m < has_faces.size(); ++m) {
      const std::string& name = attributes_.materials[m];
      if (has_faces[m] == 0) continue;
      const auto known = known_.find(name);
      if (known != known_.end()) {
        take_material(known->second);
      } else if (!known_.empty()) {
        notes_.push_back("material '" + name + "' is not in the libraries of " + path_.string() +
                         "; its faces have no colour until it is added");
      }
    }
  }

  void take_material(const Known& known) {
    const Material& from = known.material;
    FileMaterial& material =
        colors_.materials.emplace_back(FileMaterial{.name = from.name, .color = from.color});
    material.uv_scale = from.uv_scale;
    material.uv_offset = from.uv_offset;
    if (!from.image.empty()) material.image = add_image(from.image, known.library);
  }

  // Adds the image `name` that `namer` refers to. It needs texture coordinates to be shown.
  Index add_image(const std::string& name, const fs::path& namer) {
    if (!attributes_.corner_uvs.empty()) return shelf_.add(name, namer, path_);
    if (!std::exchange(lacks_corners_, true)) {
      notes_.push_back(path_.string() +
                       " has no texture coordinates; the images of its materials are not shown");
    }
    return kNoIndex;
  }

  void take_textures() {
    for (const std::string& comment : attributes_.comments) {
      if (!comment.starts_with(kTextureComment)) continue;
      colors_.are_numbered = true;
      FileMaterial& texture = colors_.materials.emplace_back();
      texture.name = comment.substr(kTextureComment.size());
      texture.image = add_image(texture.name, path_);
    }
  }

  void take_images() {
    colors_.images = shelf_.read();
    for (FileMaterial& material : colors_.materials) {
      if (material.image == kNoIndex) continue;
      if (colors_.images[material.image].rgba.empty()) material.image = kNoIndex;
    }
  }

  // Notes the faces that lack texture coordinates for the image of their material.
  void check_corners() {
    const std::vector<Index> materials = materials_of_faces(colors_, mesh_);
    std::vector<std::size_t> without(colors_.materials.size(), 0);
    for (std::size_t f = 0; f < materials.size(); ++f) {
      if (materials[f] == kNoIndex || colors_.materials[materials[f]].image == kNoIndex) continue;
      const Index* const first = attributes_.corner_uvs.data() + mesh_.face_starts()[f];
      const Index* const last = attributes_.corner_uvs.data() + mesh_.face_starts()[f + 1];
      if (std::find(first, last, kNoIndex) != last) ++without[materials[f]];
    }
    for (std::size_t m = 0; m < without.size(); ++m) {
      if (without[m] == 0) continue;
      notes_.push_back("faces of material '" + colors_.materials[m].name +
                       "' have no texture coordinates (" + grouped(without[m]) +
                       "); add texture coordinates to show the image");
    }
  }

  const Mesh& mesh_;
  const MeshAttributes& attributes_;
  const fs::path& path_;
  std::vector<std::string> notes_;
  std::unordered_map<std::string, Known> known_;
  ImageCache shelf_{notes_};
  bool lacks_corners_ = false;
  FileColors colors_;
};

// Returns the texture of a face. Without the property, all faces have the first one.
Index texture_of_face(const ExtraAttribute* numbers, std::size_t face, std::size_t count) {
  const double number = numbers == nullptr ? 0.0 : numbers->values[face];
  return number >= 0.0 && number < static_cast<double>(count) ? static_cast<Index>(number)
                                                              : kNoIndex;
}

}  // namespace

FileColors read_file_colors(const Mesh& mesh, const fs::path& path) {
  return FileColorReader(mesh, path).read();
}

std::vector<Index> materials_of_faces(const FileColors& colors, const Mesh& mesh) {
  if (colors.materials.empty()) return {};
  const MeshAttributes& attributes = mesh.attributes();
  if (!colors.are_numbered) {
    std::unordered_map<std::string_view, Index> by_name;
    for (Index m = 0; m < colors.materials.size(); ++m) {
      by_name.try_emplace(colors.materials[m].name, m);
    }
    std::vector<Index> of_faces = attributes.face_materials;
    for (Index& material : of_faces) {
      if (material == kNoIndex) continue;
      const auto known = by_name.find(attributes.materials[material]);
      material = known == by_name.end() ? kNoIndex : known->second;
    }
    return of_faces;
  }
  const auto numbers =
      std::ranges::find(attributes.face_extras, "texnumber", &ExtraAttribute::name);
  std::vector<Index> of_faces(mesh.face_count());
  for (std::size_t f = 0; f < of_faces.size(); ++f) {
    of_faces[f] = texture_of_face(numbers == attributes.face_extras.end() ? nullptr : &*numbers, f,
                                  colors.materials.size());
  }
  return of_faces;
}

}  // namespace lapwing
