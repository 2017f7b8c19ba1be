#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace lapwing {

enum class MeshFormat : std::uint8_t { obj, off, ply, stl, glb, gltf };

/// How a file stores its numbers. OBJ and OFF are always ascii, binary STL and glTF little endian.
enum class Encoding : std::uint8_t { ascii, little_endian, big_endian };

/// Number types of PLY and glTF files. Others use float64 in text and float32 in binary.
enum class Scalar : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// Bytes of one number.
std::size_t size_of(Scalar type);
bool is_integer(Scalar type);

/// Returns the format for the extension of `path`, ignoring case: .obj, .off (and .coff, .noff,
/// .cnoff), .ply, .stl, .glb, .gltf. Throws InputError for any other.
MeshFormat format_of(const std::filesystem::path& path);
bool is_gltf(MeshFormat format);

/// A mesh file, or one object of it: "scene.glb#Body".
struct MeshPath {
  std::filesystem::path file;
  std::string object;  ///< empty for all objects
};
/// Splits such a name. The object is empty if the file is not glTF, or if `path` itself exists.
MeshPath split_mesh_path(const std::filesystem::path& path);

/// "OBJ", "OFF", "PLY", "STL", "GLB", "glTF".
std::string_view name_of(MeshFormat format);

}  // namespace lapwing
