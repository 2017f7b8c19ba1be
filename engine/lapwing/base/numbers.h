#pragma once

#include <bit>
#include <cstdint>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace lapwing {

/// Allocates like std::allocator, but does not initialize elements without a value. The threads
/// that fill a large array then share the page faults, which take longer than many computations.
template <typename T>
struct UninitializedAllocator : std::allocator<T> {
  static_assert(std::is_trivially_default_constructible_v<T>);
  template <typename U>
  struct rebind {
    using other = UninitializedAllocator<U>;
  };

  void construct(T* place) noexcept { ::new (static_cast<void*>(place)) T; }
  template <typename... Arguments>
  void construct(T* place, Arguments&&... arguments) {
    ::new (static_cast<void*>(place)) T(std::forward<Arguments>(arguments)...);
  }
};

/// Returns `x`, which must be finite and not negative, rounded to 24 significant bits (seven
/// digits). For comparisons that must not depend on rounding errors.
inline double rounded_to_seven_digits(double x) {
  constexpr std::uint64_t kDropped = (std::uint64_t{1} << 29) - 1;
  return std::bit_cast<double>((std::bit_cast<std::uint64_t>(x) + (kDropped + 1) / 2) & ~kDropped);
}

/// A large array of numbers. `resize` leaves new elements uninitialized.
using Numbers = std::vector<double, UninitializedAllocator<double>>;

}  // namespace lapwing
