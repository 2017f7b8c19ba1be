#pragma once

#include <bit>
#include <cstdint>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace lapwing {

/// Allocates like std::allocator; elements that are given no value get none, where a vector would
/// clear them. The memory of a large array is then first touched by what fills it, on all threads:
/// the system hands it out page by page, which takes longer than much that is done with it.
template <typename T>
struct Uncleared : std::allocator<T> {
  static_assert(std::is_trivially_default_constructible_v<T>);
  template <typename U>
  struct rebind {
    using other = Uncleared<U>;
  };

  void construct(T* place) noexcept { ::new (static_cast<void*>(place)) T; }
  template <typename... Arguments>
  void construct(T* place, Arguments&&... arguments) {
    ::new (static_cast<void*>(place)) T(std::forward<Arguments>(arguments)...);
  }
};

/// `x`, finite and not negative, rounded to 24 significant bits, which are seven digits. For
/// comparisons whose outcome must not depend on the last bits of what was computed.
inline double rounded_to_seven_digits(double x) {
  constexpr std::uint64_t kDropped = (std::uint64_t{1} << 29) - 1;
  return std::bit_cast<double>((std::bit_cast<std::uint64_t>(x) + (kDropped + 1) / 2) & ~kDropped);
}

/// A large array of numbers. `resize` leaves the new ones undefined.
using Numbers = std::vector<double, Uncleared<double>>;

}  // namespace lapwing
