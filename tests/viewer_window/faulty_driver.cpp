#include "viewer_window/faulty_driver.h"

#include "lapwing/gpu/context.h"

namespace lapwing::viewer::test {
namespace {

VolkDeviceTable driver;
Fault planned;
int calls = 0;  // of the planned kind

bool is_due(Fault::Call call) {
  if (planned.call != call) return false;
  const int number = calls++;
  return number == planned.number || (planned.ever_after && number > planned.number);
}

VkResult VKAPI_PTR acquire(VkDevice device, VkSwapchainKHR swapchain, std::uint64_t timeout,
                           VkSemaphore semaphore, VkFence fence, std::uint32_t* index) {
  const bool due = is_due(Fault::Call::acquire);
  if (due && planned.result != VK_SUBOPTIMAL_KHR) return planned.result;
  const VkResult result =
      driver.vkAcquireNextImageKHR(device, swapchain, timeout, semaphore, fence, index);
  return due && result == VK_SUCCESS ? planned.result : result;
}

VkResult VKAPI_PTR submit(VkQueue queue, std::uint32_t count, const VkSubmitInfo2* submits,
                          VkFence fence) {
  if (is_due(Fault::Call::submit)) return planned.result;
  return driver.vkQueueSubmit2(queue, count, submits, fence);
}

VkResult VKAPI_PTR present(VkQueue queue, const VkPresentInfoKHR* info) {
  const VkResult result = driver.vkQueuePresentKHR(queue, info);
  return is_due(Fault::Call::present) ? planned.result : result;
}

}  // namespace

FaultyGraphics::FaultyGraphics(const Window& window, const Fault& fault) : real_(window, "auto") {
  planned = fault;
  calls = 0;
}

std::shared_ptr<gpu::Context> FaultyGraphics::open_device() {
  ++devices;
  auto context = real_.open_device();
  auto& table = const_cast<VolkDeviceTable&>(context->vk());
  driver = table;
  table.vkAcquireNextImageKHR = acquire;
  table.vkQueueSubmit2 = submit;
  table.vkQueuePresentKHR = present;
  return context;
}

std::unique_ptr<Screen> FaultyGraphics::open_screen(gpu::Context& context) {
  ++screens;
  return real_.open_screen(context);
}

}  // namespace lapwing::viewer::test
