#include "lapwing/io/file_colors.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <span>
#include <unordered_map>
#include <utility>

#include "lapwing/base/errors.h"
#include "lapwing/base/printable_text.h"
#include "lapwing/io/mesh_materials.h"
#include "lapwing/io/reading.h"

namespace lapwing {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostImages = 1024;
// 32-bit words in 128 MiB, less 256 KiB for the table of mip levels.
constexpr std::uint64_t kMostTexels = (std::uint64_t{1} << 25U) - (std::uint64_t{1} << 16U);
constexpr std::size_t kMostNotes = 20;

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
    const std::optional<fs::path> path = find_image(name, namer, mesh, notes_);
    if (path) known->second = add_file({.path = *path});
    return known->second;
  }
  /// Adds an image that is embedded in the mesh file.
  Index add(const std::string& name, const std::shared_ptr<const std::string>& bytes) {
    return add_file({.path = name, .bytes = bytes});
  }

  /// Reads all images, and halves them until they fit. An unreadable image has no pixels.
  std::vector<Image> read() {
    fit();
    std::vector<Image> images(files_.size());
    for (std::size_t i = 0; i < files_.size(); ++i) {
      try {
        const File& file = files_[i];
        images[i] =
            file.bytes ? decode_image(*file.bytes, file.path.string()) : read_image(file.path);
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
    std::shared_ptr<const std::string> bytes = {};  ///< content of an embedded image, else null
    ImageSize size = {};                            ///< in pixels, after all halvings
    int halvings = 0;
  };

  Index add_file(File file) {
    const auto same = std::ranges::find_if(files_, [&](const File& other) {
      return other.path == file.path && other.bytes == file.bytes;
    });
    if (same != files_.end()) return static_cast<Index>(same - files_.begin());
    if (files_.size() == kMostImages) {
      notes_.push_back(file.path.string() +
                       ": the image is not shown, because there are more than " +
                       grouped(kMostImages) + " images; combine some of them");
      return kNoIndex;
    }
    try {
      file.size = file.bytes ? decode_image_size(*file.bytes, file.path.string())
                             : read_image_size(file.path);
      files_.push_back(std::move(file));
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
      take_materials();
    } else {
      take_textures();
    }
    take_images();
    check_corners();
    note_unread();
    if (notes_.size() > kMostNotes) {
      const std::size_t more = notes_.size() - kMostNotes;
      notes_.resize(kMostNotes);
      notes_.push_back("and " + grouped(more) + " more like these");
    }
    colors_.notes = std::move(notes_);
    return std::move(colors_);
  }

 private:
  void take_materials() {
    for (const std::optional<FoundMaterial>& found : find_materials(mesh_, path_, notes_)) {
      if (found) take_material(*found);
    }
  }

  void take_material(const FoundMaterial& found) {
    const Material& from = found.material;
    FileMaterial& material =
        colors_.materials.emplace_back(FileMaterial{.name = from.name, .color = from.color});
    material.uv_scale = from.uv_scale;
    material.uv_offset = from.uv_offset;
    material.is_clamped = from.is_clamped;
    if (from.image.empty() || !has_corners()) return;
    material.image = from.embedded_image ? shelf_.add(from.image, from.embedded_image)
                                         : shelf_.add(from.image, found.file, path_);
  }

  // Returns whether the mesh has texture coordinates. If it has none, images cannot be shown, and
  // the first call adds a note.
  bool has_corners() {
    if (!attributes_.corner_uvs.empty()) return true;
    if (!std::exchange(lacks_corners_, true)) {
      notes_.push_back(path_.string() +
                       " has no texture coordinates; the images of its materials are not shown");
    }
    return false;
  }

  void take_textures() {
    for (const std::string& name : texture_names(attributes_)) {
      colors_.are_numbered = true;
      FileMaterial& texture = colors_.materials.emplace_back();
      texture.name = name;
      if (has_corners()) texture.image = shelf_.add(texture.name, path_, path_);
    }
  }

  void take_images() {
    colors_.images = shelf_.read();
    for (FileMaterial& material : colors_.materials) {
      if (material.image == kNoIndex) continue;
      if (colors_.images[material.image].rgba.empty()) material.image = kNoIndex;
    }
  }

  // Adds notes about faces that have an image but no texture coordinates, and about faces that
  // extend beyond a clamped image.
  void check_corners() {
    const std::vector<Index> materials = materials_of_faces(colors_, mesh_);
    std::vector<std::size_t> without(colors_.materials.size(), 0);
    std::vector<std::size_t> beyond(colors_.materials.size(), 0);
    for (std::size_t f = 0; f < materials.size(); ++f) {
      if (materials[f] == kNoIndex || colors_.materials[materials[f]].image == kNoIndex) continue;
      const FileMaterial& material = colors_.materials[materials[f]];
      const auto corners =
          std::span(attributes_.corner_uvs).subspan(mesh_.face_starts()[f], mesh_.face(f).size());
      if (std::ranges::find(corners, kNoIndex) != corners.end()) {
        ++without[materials[f]];
      } else if (material.is_clamped && !are_inside(material, corners)) {
        ++beyond[materials[f]];
      }
    }
    for (std::size_t m = 0; m < without.size(); ++m) {
      const std::string faces = "faces of material '" + colors_.materials[m].name + "' ";
      if (without[m] > 0) {
        notes_.push_back(faces + "have no texture coordinates (" + grouped(without[m]) +
                         "); add texture coordinates to show the image");
      }
      if (beyond[m] > 0) {
        notes_.push_back(faces + "are partly beyond their image (" + grouped(beyond[m]) +
                         "), which their file clamps; here it is repeated");
      }
    }
  }

  // Returns whether all corners lie inside the image, up to rounding.
  bool are_inside(const FileMaterial& material, std::span<const Index> corners) const {
    constexpr double kRounding = 1e-4;
    return std::ranges::all_of(corners, [&](Index uv) {
      const Eigen::Vector2d at =
          material.uv_scale.cwiseProduct(attributes_.uvs[uv]) + material.uv_offset;
      return at.minCoeff() > -kRounding && at.maxCoeff() < 1.0 + kRounding;
    });
  }

  // Adds notes about colour map indices, which the reader of the mesh cannot use, and about
  // undeclared numbers, which may be colours.
  void note_unread() {
    for (const std::string& what : attributes_.uneditable) {
      const bool are_indices = what.starts_with(kColorMapIndices);
      if (!are_indices && !what.starts_with(kUndeclaredNumbers)) continue;
      notes_.push_back(path_.string() + " has " + what + ", which are not shown; " +
                       (are_indices ? "write the colours of the map instead, as red green blue"
                                    : "if they are colours, begin the file with COFF"));
    }
  }

  const Mesh& mesh_;
  const MeshAttributes& attributes_;
  const fs::path& path_;
  std::vector<std::string> notes_;
  ImageCache shelf_{notes_};
  bool lacks_corners_ = false;
  FileColors colors_;
};

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
  return textures_of_faces(mesh, colors.materials.size());
}

}  // namespace lapwing
