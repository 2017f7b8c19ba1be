#pragma once

namespace lapwing::test {

/// The calls to a Vulkan driver that are counted, so that one of them fails.
enum class DriverFault {
  none,
  loss,    ///< submissions and waits; the device is then lost
  memory,  ///< creations and allocations, which then report that there is no memory
};

}  // namespace lapwing::test
