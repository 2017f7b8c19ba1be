#pragma once

#include <memory>

#include <volk.h>

#include "window/main_loop.h"

namespace lapwing::viewer::test {

/// A call to the driver that comes back with another result than the driver's.
struct Fault {
  enum class Call { none, acquire, submit, present };

  Call call = Call::none;
  VkResult result = VK_SUCCESS;
  int number = 0;  ///< of that kind's calls, from 0
  bool ever_after = false;
};

/// A window's graphics on a driver with one fault; one at a time. It counts what was opened.
///
/// The driver itself is called where Vulkan says that a call has effects in spite of its result: an
/// image is acquired although suboptimal, and presenting waits for its semaphores always.
class FaultyGraphics final : public Graphics {
 public:
  FaultyGraphics(const Window& window, const Fault& fault);

  std::shared_ptr<gpu::Context> open_device() override;
  std::unique_ptr<Screen> open_screen(gpu::Context& context) override;

  int devices = 0;
  int screens = 0;

 private:
  WindowGraphics real_;
};

}  // namespace lapwing::viewer::test
