#pragma once

#include <cstddef>
#include <memory>

namespace lapwing::cholesky {

/// A block of numbers that only grows, aligned for vectors, on huge pages where the system has
/// them (touching 4 KiB pages one by one takes longer than factoring what lies in them). Its
/// contents are undefined after `reserve` has grown it. Large ones are not cleared: pages are
/// first touched by the thread that needs them, and kept for the next arena, up to
/// kMostSpareBytes in the whole program.
class Arena {
 public:
  /// Makes room for `count` numbers. Throws std::bad_alloc; the arena is then empty.
  void reserve(std::size_t count);
  /// Has the system clear its pages now, in place of when they are first used. Throws Cancelled.
  void touch();
  double* data() const { return data_.get(); }
  std::size_t bytes() const { return data_ ? data_.get_deleter().bytes : 0; }

 private:
  struct Release {
    Release() : Release(0, 0) {}
    Release(std::size_t unit, std::size_t size) : alignment(unit), bytes(size) {}
    void operator()(double* memory) const;

    std::size_t alignment;
    std::size_t bytes;
  };
  std::unique_ptr<double[], Release> data_;
};

/// What all arenas of the program together keep when they end.
inline constexpr std::size_t kMostSpareBytes = std::size_t{256} << 20;
/// Gives it back to the system.
void free_spare_memory();

/// What `reserve(count)` takes from the system.
std::size_t arena_bytes(std::size_t count);

}  // namespace lapwing::cholesky
