#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lapwing/io/source_file.h"

namespace lapwing {

/// One property of a PLY element: a number, or a list with its count's type.
struct PlyProperty {
  std::string name;
  Scalar type = Scalar::float32;
  std::optional<Scalar> count_type;  ///< set for a list
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
  std::uint64_t header_offset = 0;  ///< of its line, for messages

  bool has_list() const;
  /// Size of a binary record in bytes, without the contents of its lists.
  std::uint64_t binary_size() const;
};

struct PlyHeader {
  Encoding encoding = Encoding::ascii;
  std::vector<PlyElement> elements;
  std::vector<std::string> comments;  ///< of `comment` and `obj_info` lines
  std::uint64_t data_offset = 0;      ///< first byte behind the header
};

/// Throws InputError, naming the line, when the header is malformed or promises more records than
/// the file has room for.
PlyHeader read_ply_header(const SourceFile& file);

/// Convert between types and their PLY names. `ply_type` takes both spellings ("uchar", "uint8").
std::string_view ply_name(Scalar type);
std::optional<Scalar> ply_type(std::string_view name);

}  // namespace lapwing
