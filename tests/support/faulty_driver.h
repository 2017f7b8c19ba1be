#pragma once

#include <functional>

#include <gtest/gtest.h>

#include "support/environment.h"
#include "support/faulty_loader.h"

namespace lapwing::test {

/// While this object exists, contexts use the machine's Vulkan driver through faulty_loader.cpp,
/// which makes one call fail.
class FaultyDriver {
 public:
  FaultyDriver();
  ~FaultyDriver();

  /// Makes one of the calls that `fault` counts fail. `number` is the index of this call, counted
  /// from 0 from now on. If `ever_after` is true, all later calls also fail.
  void fail(DriverFault fault, long number, bool ever_after = false) const;
  void work() const { fail(DriverFault::none, 0); }
  /// Returns whether a call has failed since the last call of `fail`.
  bool has_failed() const;

  /// Returns the path of the loader library, the value of LAPWING_VULKAN_LOADER. In other programs,
  /// the loader reads the fault from LAPWING_DRIVER_FAULT: "loss 3", "memory 5" or "memory 5 ever
  /// after". If the library was moved after the build, LAPWING_TEST_FAULTY_LOADER is its path.
  static const char* loader();

 private:
  Environment environment_;
  void* library_;
};

/// Calls `act` repeatedly. The first driver call that `fault` counts fails in the first run, the
/// second one in the second run, and so on until no call fails. Before each run, calls `prepare`
/// with a driver that works. Returns the number of driver calls.
long for_every_call(const FaultyDriver& driver, DriverFault fault,
                    const std::function<void()>& prepare, const std::function<void()>& act);

inline const char* name_of(DriverFault fault) {
  return fault == DriverFault::loss ? "loss" : "memory";
}

}  // namespace lapwing::test
