#pragma once

#include <functional>

#include <gtest/gtest.h>

#include "support/environment.h"
#include "support/faulty_loader.h"

namespace lapwing::test {

/// While alive, contexts use the machine's Vulkan through faulty_loader.cpp, which lets one call
/// fail.
class FaultyDriver {
 public:
  FaultyDriver();
  ~FaultyDriver();

  /// Lets call `number`, from 0 and from now on, of those that `fault` counts fail; with
  /// `ever_after`, all later ones too.
  void fail(DriverFault fault, long number, bool ever_after = false) const;
  void work() const { fail(DriverFault::none, 0); }
  /// Returns whether a call has failed since.
  bool has_failed() const;

  /// Returns the file of the loader, for LAPWING_VULKAN_LOADER. Another program that uses it reads
  /// the fault from LAPWING_DRIVER_FAULT: "loss 3", "memory 5", "memory 5 ever after".
  /// LAPWING_TEST_FAULTY_LOADER names the file if it is not where it was built.
  static const char* loader();

 private:
  Environment environment_;
  void* library_;
};

/// Calls `act` repeatedly: first the first call that `fault` counts fails, then the second, until
/// `act` makes no more of them. Calls `prepare` before each, while the driver works. Returns the
/// number of calls.
long for_every_call(const FaultyDriver& driver, DriverFault fault,
                    const std::function<void()>& prepare, const std::function<void()>& act);

inline const char* name_of(DriverFault fault) {
  return fault == DriverFault::loss ? "loss" : "memory";
}

}  // namespace lapwing::test
