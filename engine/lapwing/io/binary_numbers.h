#pragma once

#include <algorithm>
#include <array>
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

/// Calls `act` with a zero of the C++ type that corresponds to `type`.
template <class Act>
auto with_type_of(Scalar type, const Act& act) {
  switch (type) {
    case Scalar::int8:
      return act(std::int8_t{});
    case Scalar::uint8:
      return act(std::uint8_t{});
    case Scalar::int16:
      return act(std::int16_t{});
    case Scalar::uint16:
      return act(std::uint16_t{});
    case Scalar::int32:
      return act(std::int32_t{});
    case Scalar::uint32:
      return act(std::uint32_t{});
    case Scalar::float32:
      return act(float{});
    case Scalar::float64:
      break;
  }
  return act(double{});
}

/// Converts a number between the byte order of `encoding` and this machine's byte order.
template <std::size_t N>
void reorder(std::array<char, N>& bytes, Encoding encoding) {
  const bool is_big = std::endian::native == std::endian::big;
  if ((encoding == Encoding::big_endian) != is_big) std::ranges::reverse(bytes);
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

}  // namespace detail

/// Returns the number of the given type and byte order at `from`. Every type fits a double.
inline double load_number(const char* from, Scalar type, Encoding encoding) {
  return detail::with_type_of(type, [&]<class T>(T) {
    std::array<char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), from, sizeof(T));
    detail::reorder(bytes, encoding);
    return static_cast<double>(std::bit_cast<T>(bytes));
  });
}

/// Writes `size_of(type)` bytes to `to`. Integers are rounded and clamped to their range; NaN
/// becomes 0.
inline void store_number(char* to, double value, Scalar type, Encoding encoding) {
  detail::with_type_of(type, [&]<class T>(T) {
    auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(detail::convert<T>(value));
    detail::reorder(bytes, encoding);
    std::memcpy(to, bytes.data(), sizeof(T));
  });
}

inline void append_binary(std::string& out, double value, Scalar type, Encoding encoding) {
  const std::size_t at = out.size();
  out.resize(at + size_of(type));
  store_number(out.data() + at, value, type, encoding);
}

}  // namespace lapwing
