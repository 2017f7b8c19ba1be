#include "lapwing/io/mesh_format.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>

#include "lapwing/base/errors.h"

namespace lapwing {

std::size_t size_of(Scalar type) {
  constexpr std::array<std::size_t, 8> kSizes{1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

bool is_integer(Scalar type) {
  return type < Scalar::float32;
}

MeshFormat format_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension == ".obj") return MeshFormat::obj;
  if (extension == ".ply") return MeshFormat::ply;
  if (extension == ".stl") return MeshFormat::stl;
  if (extension == ".off" || extension == ".coff" || extension == ".noff" ||
      extension == ".cnoff") {
    return MeshFormat::off;
  }
  throw InputError(path.string() + ": '" + extension +
                   "' is no mesh format that can be read or written; use .obj, .off, .ply or .stl");
}

std::string_view name_of(MeshFormat format) {
  constexpr std::array<std::string_view, 4> kNames{"OBJ", "OFF", "PLY", "STL"};
  return kNames[static_cast<std::size_t>(format)];
}

}  // namespace lapwing
