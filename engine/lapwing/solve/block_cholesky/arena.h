#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <new>

namespace lapwing::cholesky {

/// A block of memory that only grows, aligned for vectors, on huge pages where the system has
/// them (touching 4 KiB pages one by one takes longer than factoring what lies in them). Its
/// contents are undefined after `reserve` has grown it. Large ones are not cleared: pages are
/// first touched by the thread that needs them, and kept for the next block, up to
/// kMostSpareBytes in the whole program.
class ArenaBlock {
 public:
  /// Throws std::bad_alloc; the block is then empty.
  void reserve(std::size_t wanted_bytes);
  /// Has the system clear its pages now, in place of when they are first used. Throws Cancelled.
  void touch();
  std::byte* data() const { return data_.get(); }
  std::size_t bytes() const { return data_ ? data_.get_deleter().bytes : 0; }

 private:
  struct Release {
    Release() : Release(0, 0) {}
    Release(std::size_t unit, std::size_t size) : alignment(unit), bytes(size) {}
    void operator()(std::byte* memory) const;

    std::size_t alignment;
    std::size_t bytes;
  };
  std::unique_ptr<std::byte[], Release> data_;
};

/// What `reserve` of a block takes from the system.
std::size_t arena_block_bytes(std::size_t bytes);

/// What an arena of `count` numbers takes from the system.
template <typename Real>
std::size_t arena_bytes(std::size_t count) {
  if (count > std::numeric_limits<std::size_t>::max() / sizeof(Real)) throw std::bad_alloc();
  return arena_block_bytes(count * sizeof(Real));
}

/// Numbers in such a block.
template <typename Real>
class Arena {
 public:
  /// Makes room for `count` numbers. Throws std::bad_alloc; the arena is then empty.
  void reserve(std::size_t count) { block_.reserve(arena_bytes<Real>(count)); }
  void touch() { block_.touch(); }
  Real* data() const { return reinterpret_cast<Real*>(block_.data()); }
  std::size_t bytes() const { return block_.bytes(); }

 private:
  ArenaBlock block_;
};

/// What all arenas of the program together keep when they end.
inline constexpr std::size_t kMostSpareBytes = std::size_t{256} << 20;
/// Gives it back to the system.
void free_spare_memory();

}  // namespace lapwing::cholesky
