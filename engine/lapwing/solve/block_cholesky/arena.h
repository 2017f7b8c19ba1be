#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <new>

namespace lapwing::cholesky {

/// A block of memory that only grows. It is aligned for vector instructions, and uses huge pages if
/// the system supports them: first accesses to 4 KiB pages take longer in total than the
/// factorization. Its contents are undefined after `reserve` has grown it. Large blocks are not
/// cleared, so that each page is first touched by a thread that uses it. Freed blocks are cached
/// for reuse, up to kMostSpareBytes in the whole program.
class ArenaBlock {
 public:
  /// Throws std::bad_alloc; the block is then empty.
  void reserve(std::size_t wanted_bytes);
  /// Writes to all pages, so that the system clears them now instead of at their first use.
  /// Overwrites the contents. Throws Cancelled.
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

/// Returns the number of bytes that ArenaBlock::reserve(bytes) allocates from the system.
std::size_t arena_block_bytes(std::size_t bytes);

/// Returns the number of bytes that Arena::reserve(count) allocates from the system.
template <typename Real>
std::size_t arena_bytes(std::size_t count) {
  if (count > std::numeric_limits<std::size_t>::max() / sizeof(Real)) throw std::bad_alloc();
  return arena_block_bytes(count * sizeof(Real));
}

/// An array of numbers in an ArenaBlock.
template <typename Real>
class Arena {
 public:
  /// Reserves memory for `count` numbers. Throws std::bad_alloc; the arena is then empty.
  void reserve(std::size_t count) { block_.reserve(arena_bytes<Real>(count)); }
  void touch() { block_.touch(); }
  Real* data() const { return reinterpret_cast<Real*>(block_.data()); }
  std::size_t bytes() const { return block_.bytes(); }

 private:
  ArenaBlock block_;
};

/// Largest total size of freed blocks that are cached for reuse, in the whole program.
inline constexpr std::size_t kMostSpareBytes = std::size_t{256} << 20;
/// Returns the cached blocks to the system.
void free_spare_memory();

}  // namespace lapwing::cholesky
