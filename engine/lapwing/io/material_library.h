#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace lapwing {

/// The unlit colour of a material, from an MTL or glTF file.
struct Material {
  std::string name;
  std::optional<Eigen::Vector3f> color;  ///< Kd: sRGB in [0, 1]
  std::string image;                     ///< map_Kd as written, without its options; empty if none
  /// -s and -o of map_Kd: the image is looked up at scale * uv + offset.
  Eigen::Vector2d uv_scale = Eigen::Vector2d::Ones();
  Eigen::Vector2d uv_offset = Eigen::Vector2d::Zero();
};

/// Returns the materials of an MTL file in its order; of two with the same name, the first. What
/// cannot be read is left out and becomes one of `notes`: "path:line: what; next step". Throws
/// IoError if the file cannot be read, and InputError if it is larger than 64 MiB.
std::vector<Material> read_material_library(const std::filesystem::path& path,
                                            std::vector<std::string>& notes);

}  // namespace lapwing
