#pragma once

#include <cstddef>

#include "lapwing/io/reading.h"

namespace lapwing {

/// Layout of a binary STL file, in bytes: free text and a count, then per facet a normal, three
/// corners and two bytes of attribute.
inline constexpr std::size_t kStlTextSize = 80;
inline constexpr std::size_t kStlHeaderSize = kStlTextSize + 4;
inline constexpr std::size_t kStlFacetSize = 50;
inline constexpr Encoding kStlOrder = Encoding::little_endian;

}  // namespace lapwing
