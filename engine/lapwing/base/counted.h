#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace lapwing {

/// Returns a plural noun phrase in the singular: "vertex", "face that repeats a vertex". The first
/// word in -s is the noun. A phrase that begins with "of" has none.
std::string singular(std::string_view plural);

/// Returns a count and its noun: "3 vertices", "1 vertex".
inline std::string counted(std::size_t count, std::string_view plural) {
  return std::to_string(count) + " " + (count == 1 ? singular(plural) : std::string(plural));
}

}  // namespace lapwing
