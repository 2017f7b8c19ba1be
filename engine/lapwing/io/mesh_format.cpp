#include "lapwing/io/mesh_format.h"

#include <array>
#include <string>

#include "lapwing/base/errors.h"
#include "lapwing/io/text_scanner.h"

namespace lapwing {

std::size_t size_of(Scalar type) {
  constexpr std::array<std::size_t, 8> kSizes{1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

bool is_integer(Scalar type) {
  return type < Scalar::float32;
}

MeshFormat format_of(const std::filesystem::path& path) {
  const std::string extension = lowered(path.extension().string());
  if (extension == ".obj") return MeshFormat::obj;
  if (extension == ".ply") return MeshFormat::ply;
  if (extension == ".stl") return MeshFormat::stl;
  if (extension == ".off" || extension == ".coff" || extension == ".noff" ||
      extension == ".cnoff") {
    return MeshFormat::off;
  }
  if (extension == ".glb") return MeshFormat::glb;
  if (extension == ".gltf") return MeshFormat::gltf;
  throw InputError(path.string() + ": unsupported mesh format: " +
                   (extension.empty() ? "the file has no extension" : "'" + extension + "'") +
                   ". Use .obj, .off, .ply, .stl, .gltf or .glb");
}

bool is_gltf(MeshFormat format) {
  return format == MeshFormat::glb || format == MeshFormat::gltf;
}

MeshPath split_mesh_path(const std::filesystem::path& path) {
  const std::string name = path.filename().string();
  const std::string lower = lowered(name);
  for (const std::string_view mark : {".glb#", ".gltf#"}) {
    const std::size_t at = lower.find(mark);
    std::error_code error;
    if (at == std::string::npos || std::filesystem::exists(path, error)) continue;
    const std::size_t hash = at + mark.size() - 1;
    return {path.parent_path() / name.substr(0, hash), name.substr(hash + 1)};
  }
  return {path, {}};
}

std::string_view name_of(MeshFormat format) {
  constexpr std::array<std::string_view, 6> kNames{"OBJ", "OFF", "PLY", "STL", "GLB", "glTF"};
  return kNames[static_cast<std::size_t>(format)];
}

}  // namespace lapwing
