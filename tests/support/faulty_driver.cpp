#include "support/faulty_driver.h"

#include <cstdlib>
#include <dlfcn.h>

namespace lapwing::test {
namespace {

template <typename Function>
Function find(void* library, const char* name) {
  return reinterpret_cast<Function>(dlsym(library, name));
}

}  // namespace

const char* FaultyDriver::loader() {
  const char* const elsewhere = std::getenv("LAPWING_TEST_FAULTY_LOADER");
  return elsewhere != nullptr ? elsewhere : LAPWING_FAULTY_LOADER;
}

// Like the real loader, the library is never closed.
FaultyDriver::FaultyDriver()
    : environment_("LAPWING_VULKAN_LOADER", loader()), library_(dlopen(loader(), RTLD_NOW)) {
  EXPECT_NE(library_, nullptr) << dlerror();
}

FaultyDriver::~FaultyDriver() {
  work();
}

void FaultyDriver::fail(DriverFault fault, long number, bool ever_after) const {
  find<void (*)(DriverFault, long, bool)>(library_, "lapwing_fail_driver")(fault, number,
                                                                           ever_after);
}

bool FaultyDriver::has_failed() const {
  return find<bool (*)()>(library_, "lapwing_driver_has_failed")();
}

long for_every_call(const FaultyDriver& driver, DriverFault fault,
                    const std::function<void()>& prepare, const std::function<void()>& act) {
  for (long number = 0;; ++number) {
    SCOPED_TRACE(std::string(name_of(fault)) + " at call " + std::to_string(number));
    prepare();
    driver.fail(fault, number);
    act();
    const bool was_reached = driver.has_failed();
    driver.work();
    if (!was_reached || ::testing::Test::HasFatalFailure()) return number;
  }
}

}  // namespace lapwing::test
