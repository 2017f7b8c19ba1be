#include "lapwing/solve/block_cholesky/arena.h"

#include <limits>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace lapwing::cholesky {
namespace {

constexpr std::size_t kHugePage = std::size_t{2} << 20;
constexpr std::size_t kCacheLine = 64;

}  // namespace

std::size_t arena_bytes(std::size_t count) {
  if (count > (std::numeric_limits<std::size_t>::max() - kHugePage) / sizeof(double)) {
    throw std::bad_alloc();
  }
  const std::size_t bytes = count * sizeof(double);
  const std::size_t unit = bytes >= kHugePage ? kHugePage : kCacheLine;
  return (bytes + unit - 1) / unit * unit;
}

void Arena::Release::operator()(double* memory) const {
  ::operator delete(memory, std::align_val_t(alignment));
}

void Arena::reserve(std::size_t count) {
  const std::size_t bytes = arena_bytes(count);
  if (bytes <= bytes_) return;
  data_.reset();
  bytes_ = 0;
  const std::size_t alignment = bytes >= kHugePage ? kHugePage : kCacheLine;
  auto* memory = static_cast<double*>(::operator new(bytes, std::align_val_t(alignment)));
  data_ = std::unique_ptr<double[], Release>(memory, Release{alignment});
  bytes_ = bytes;
#ifdef MADV_HUGEPAGE
  // Only a hint: without huge pages everything works, a little slower.
  if (alignment == kHugePage) madvise(memory, bytes, MADV_HUGEPAGE);
#endif
}

}  // namespace lapwing::cholesky
