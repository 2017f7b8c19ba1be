#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace lapwing {

/// What an MTL file says of the colour of a surface without light on it.
struct Material {
  std::string name;
  std::optional<Eigen::Vector3f> color;  ///< Kd: sRGB in [0, 1]
  std::string image;                     ///< map_Kd as written, without its options; empty if none
  /// -s and -o of map_Kd: the image is looked up at scale * uv + offset.
  Eigen::Vector2d uv_scale = Eigen::Vector2d::Ones();
  Eigen::Vector2d uv_offset = Eigen::Vector2d::Zero();
};

/// The materials of an MTL file in its order, and of two with one name the first. What cannot be
/// read becomes one of `notes`, "path:line: what; next step", and is left out. Throws IoError when
/// the file cannot be read, InputError when it is larger than 64 MiB.
std::vector<Material> read_material_library(const std::filesystem::path& path,
                                            std::vector<std::string>& notes);

}  // namespace lapwing
