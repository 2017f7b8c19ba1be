#pragma once

namespace lapwing::test {

/// Which calls to a Vulkan driver are counted, so that one of them fails.
enum class DriverFault {
  none,
  loss,    ///< submissions and waits: the device is lost from there on
  memory,  ///< what makes an object or takes memory: it says that there is none
};

}  // namespace lapwing::test
