#pragma once

namespace lapwing::test {

/// The kinds of Vulkan driver calls that are counted and of which one fails.
enum class DriverFault {
  none,
  loss,    ///< submissions and waits, which lose the device
  memory,  ///< creations and allocations, which report that memory ran out
};

}  // namespace lapwing::test
