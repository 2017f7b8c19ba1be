#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace lapwing {

/// Converts a plural noun phrase to the singular, for example "faces that repeat a vertex" to "face
/// that repeats a vertex". The noun is the first word that ends in -s. A phrase that begins with
/// "of" has no noun and is not changed.
std::string singular(std::string_view plural);

/// Returns a count followed by its noun, such as "3 vertices" or "1 vertex".
inline std::string counted(std::size_t count, std::string_view plural) {
  return std::to_string(count) + " " + (count == 1 ? singular(plural) : std::string(plural));
}

}  // namespace lapwing
