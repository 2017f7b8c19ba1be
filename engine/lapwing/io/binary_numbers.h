#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <type_traits>

#include "lapwing/io/mesh_format.h"

namespace lapwing {

namespace detail {

template <class Unsigned>
constexpr Unsigned swap_bytes(Unsigned value) {
  Unsigned swapped = 0;
  for (std::size_t i = 0; i < sizeof value; ++i) {
    swapped = static_cast<Unsigned>((swapped << 8U) | ((value >> (8U * i)) & 0xFFU));
  }
  return swapped;
}

inline bool is_foreign(Encoding encoding) {
  return (encoding == Encoding::big_endian) != (std::endian::native == std::endian::big);
}

template <class T, class Bits>
T load_as(const char* from, bool foreign) {
  Bits bits = 0;
  std::memcpy(&bits, from, sizeof bits);
  if constexpr (sizeof bits > 1) {
    if (foreign) bits = swap_bytes(bits);
  }
  return std::bit_cast<T>(bits);
}

template <class T>
T convert(double value) {
  if constexpr (std::is_floating_point_v<T>) {
    return static_cast<T>(value);
  } else {
    if (std::isnan(value)) return 0;
    return static_cast<T>(std::clamp(std::round(value), double{std::numeric_limits<T>::min()},
                                     double{std::numeric_limits<T>::max()}));
  }
}

template <class T, class Bits>
void store_as(char* to, double value, bool foreign) {
  auto bits = std::bit_cast<Bits>(convert<T>(value));
  if constexpr (sizeof bits > 1) {
    if (foreign) bits = swap_bytes(bits);
  }
  std::memcpy(to, &bits, sizeof bits);
}

}  // namespace detail

/// Returns the number of the given type and byte order at `from`. Every type fits a double.
inline double load_number(const char* from, Scalar type, Encoding encoding) {
  using namespace detail;
  const bool foreign = is_foreign(encoding);
  switch (type) {
    case Scalar::int8:
      return load_as<std::int8_t, std::uint8_t>(from, foreign);
    case Scalar::uint8:
      return load_as<std::uint8_t, std::uint8_t>(from, foreign);
    case Scalar::int16:
      return load_as<std::int16_t, std::uint16_t>(from, foreign);
    case Scalar::uint16:
      return load_as<std::uint16_t, std::uint16_t>(from, foreign);
    case Scalar::int32:
      return load_as<std::int32_t, std::uint32_t>(from, foreign);
    case Scalar::uint32:
      return load_as<std::uint32_t, std::uint32_t>(from, foreign);
    case Scalar::float32:
      return double{load_as<float, std::uint32_t>(from, foreign)};
    case Scalar::float64:
      return load_as<double, std::uint64_t>(from, foreign);
  }
  return 0.0;
}

/// Writes `size_of(type)` bytes to `to`. Integers are rounded and clamped to their range; NaN
/// becomes 0.
inline void store_number(char* to, double value, Scalar type, Encoding encoding) {
  using namespace detail;
  const bool foreign = is_foreign(encoding);
  switch (type) {
    case Scalar::int8:
      store_as<std::int8_t, std::uint8_t>(to, value, foreign);
      break;
    case Scalar::uint8:
      store_as<std::uint8_t, std::uint8_t>(to, value, foreign);
      break;
    case Scalar::int16:
      store_as<std::int16_t, std::uint16_t>(to, value, foreign);
      break;
    case Scalar::uint16:
      store_as<std::uint16_t, std::uint16_t>(to, value, foreign);
      break;
    case Scalar::int32:
      store_as<std::int32_t, std::uint32_t>(to, value, foreign);
      break;
    case Scalar::uint32:
      store_as<std::uint32_t, std::uint32_t>(to, value, foreign);
      break;
    case Scalar::float32:
      store_as<float, std::uint32_t>(to, value, foreign);
      break;
    case Scalar::float64:
      store_as<double, std::uint64_t>(to, value, foreign);
      break;
  }
}

inline void append_binary(std::string& out, double value, Scalar type, Encoding encoding) {
  const std::size_t at = out.size();
  out.resize(at + size_of(type));
  store_number(out.data() + at, value, type, encoding);
}

}  // namespace lapwing
