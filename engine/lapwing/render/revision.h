#pragma once

#include <atomic>
#include <cstdint>

namespace lapwing {

/// Identifies the contents of an object on the device. Every object and every change has a new
/// number, so an image is up to date while the numbers of all drawn objects are unchanged.
class Revision {
 public:
  Revision() : number_(next()) {}

  /// Call this when the contents change.
  void renew() { number_ = next(); }
  std::uint64_t number() const { return number_; }

 private:
  static std::uint64_t next() {
    static std::atomic<std::uint64_t> last{0};
    return ++last;
  }

  std::uint64_t number_;
};

}  // namespace lapwing
