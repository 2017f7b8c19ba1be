#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <new>

namespace lapwing::cholesky {

/// A block of memory that only grows, aligned for vectors, on huge pages if the system has them
/// (touching 4 KiB pages one by one takes longer than the factorization in them). Its contents are
/// undefined after `reserve` has grown it. Large blocks are not cleared, so that the thread that
/// needs a page touches it first. Freed blocks are kept for later ones, up to kMostSpareBytes in
/// the whole program.
class ArenaBlock {
 public:
  /// Throws std::bad_alloc; the block is then empty.
  void reserve(std::size_t wanted_bytes);
  /// Lets the system clear all pages now instead of at their first use. Throws Cancelled.
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

/// Returns the bytes that a block of `bytes` takes from the system.
std::size_t arena_block_bytes(std::size_t bytes);

/// Returns the bytes that an arena of `count` numbers takes from the system.
template <typename Real>
std::size_t arena_bytes(std::size_t count) {
  if (count > std::numeric_limits<std::size_t>::max() / sizeof(Real)) throw std::bad_alloc();
  return arena_block_bytes(count * sizeof(Real));
}

/// An array of numbers in an ArenaBlock.
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

/// Most memory that freed arenas keep for later ones, in the whole program.
inline constexpr std::size_t kMostSpareBytes = std::size_t{256} << 20;
/// Returns that memory to the system.
void free_spare_memory();

}  // namespace lapwing::cholesky
