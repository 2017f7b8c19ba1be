#pragma once

#include <cstddef>
#include <memory>

namespace lapwing::cholesky {

/// A block of numbers that only grows, aligned for vectors, on huge pages where the system has
/// them (touching 4 KiB pages one by one takes longer than factoring what lies in them). Its
/// contents are undefined after `reserve` has grown it. Large ones are not cleared: pages are
/// first touched by the thread that needs them.
class Arena {
 public:
  /// Makes room for `count` numbers. Throws std::bad_alloc; the arena is then empty.
  void reserve(std::size_t count);
  double* data() const { return data_.get(); }
  std::size_t bytes() const { return bytes_; }

 private:
  struct Release {
    std::size_t alignment;
    void operator()(double* memory) const;
  };
  std::unique_ptr<double[], Release> data_;
  std::size_t bytes_ = 0;
};

/// What `reserve(count)` takes from the system.
std::size_t arena_bytes(std::size_t count);

}  // namespace lapwing::cholesky
