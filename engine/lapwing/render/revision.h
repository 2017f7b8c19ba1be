#pragma once

#include <atomic>
#include <cstdint>

namespace lapwing {

/// A number that says which contents a thing on the device has: no two things, and no two contents
/// of one, ever share a number. What was drawn from equal numbers is drawn already.
class Revision {
 public:
  Revision() : number_(next()) {}

  /// The contents have changed, or are about to.
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
