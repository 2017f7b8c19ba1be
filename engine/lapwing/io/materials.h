#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace lapwing {

/// The unlit colour of a material, from an MTL or glTF file.
struct Material {
  std::string name;
  std::optional<Eigen::Vector3f> color;  ///< Kd: sRGB in [0, 1]
  float opacity = 1.0F;                  ///< d, or 1 - Tr, in [0, 1]
  std::string image;                     ///< map_Kd as written, without its options; empty if none
  /// The bytes of the image if it is embedded in a glTF file. In this case, `image` is its name.
  std::shared_ptr<const std::string> embedded_image;
  /// The image is sampled at scale * uv + offset. The values are those of -s and -o of map_Kd, or
  /// of KHR_texture_transform.
  Eigen::Vector2d uv_scale = Eigen::Vector2d::Ones();
  Eigen::Vector2d uv_offset = Eigen::Vector2d::Zero();
  /// The image is not repeated: -clamp on, or the wrap modes CLAMP_TO_EDGE of a glTF sampler.
  bool is_clamped = false;
  std::size_t further_images = 0;  ///< other images in an MTL file: map_Bump, map_Ks, ...
};

/// Returns the materials of an MTL file in the order of the file. If two have the same name,
/// returns the first one. Each statement that cannot be read is left out and adds one of `notes`:
/// "path:line: what; next step". Throws IoError if the file cannot be read, and InputError if it is
/// larger than 64 MiB or of another kind (FileBytes::read_data).
std::vector<Material> read_material_library(const std::filesystem::path& path,
                                            std::vector<std::string>& notes);

/// Returns the materials of the glTF file at `path`, with their base colours and the names that
/// read_gltf gives them. Each malformed material adds one of `notes`. Throws IoError or InputError
/// if the file cannot be read.
std::vector<Material> read_gltf_materials(const std::filesystem::path& path,
                                          std::vector<std::string>& notes);

/// Returns the file extension for the bytes of an image: ".png", ".jpg", ".webp", ".avif",
/// ".ktx2", ".dds", or ".image" for an unknown format.
std::string_view image_extension(std::string_view bytes);

}  // namespace lapwing
