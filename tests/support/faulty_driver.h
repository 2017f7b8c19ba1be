#pragma once

#include <functional>

#include <gtest/gtest.h>

#include "support/environment.h"
#include "support/faulty_loader.h"

namespace lapwing::test {

/// While alive, contexts are made on the machine's Vulkan by way of faulty_loader.cpp, which has
/// one call fail.
class FaultyDriver {
 public:
  FaultyDriver();
  ~FaultyDriver();

  /// From here on call `number` of those that `fault` counts fails, from 0; `ever_after`, so do all
  /// that follow.
  void fail(DriverFault fault, long number, bool ever_after = false) const;
  void work() const { fail(DriverFault::none, 0); }
  /// Whether it has, since.
  bool has_failed() const;

  /// The loader, as LAPWING_VULKAN_LOADER; a program that it is given to reads what is to fail from
  /// LAPWING_DRIVER_FAULT: "loss 3", "memory 5", "memory 5 ever after". LAPWING_TEST_FAULTY_LOADER
  /// says where it is, if not where it was built.
  static const char* loader();

 private:
  Environment environment_;
  void* library_;
};

/// Calls `act` with the first call that `fault` counts failing, then the second, until it makes no
/// more of them, each time after `prepare`, for which the driver works. Returns how many there
/// were.
long for_every_call(const FaultyDriver& driver, DriverFault fault,
                    const std::function<void()>& prepare, const std::function<void()>& act);

inline const char* name_of(DriverFault fault) {
  return fault == DriverFault::loss ? "loss" : "memory";
}

}  // namespace lapwing::test
