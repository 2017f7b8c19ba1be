#include "lapwing/gpu/results.h"

#include "lapwing/base/errors.h"
#include "lapwing/gpu/devices.h"

namespace lapwing::gpu {
namespace {

const char* next_step(VkResult result) {
  switch (result) {
    case VK_ERROR_DEVICE_LOST:
      return "; the driver lost the device. Try again, or run with --device cpu";
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
    case VK_ERROR_OUT_OF_HOST_MEMORY:
      return "; close other programs that use the device, or run with --device cpu";
    default:
      return "; set LAPWING_VALIDATION=1 to learn why, or run with --device cpu";
  }
}

}  // namespace

std::string result_name(VkResult result) {
#define LAPWING_NAME(name) \
  case name:               \
    return #name
  switch (result) {
    LAPWING_NAME(VK_SUCCESS);
    LAPWING_NAME(VK_NOT_READY);
    LAPWING_NAME(VK_TIMEOUT);
    LAPWING_NAME(VK_INCOMPLETE);
    LAPWING_NAME(VK_SUBOPTIMAL_KHR);
    LAPWING_NAME(VK_ERROR_OUT_OF_HOST_MEMORY);
    LAPWING_NAME(VK_ERROR_OUT_OF_DEVICE_MEMORY);
    LAPWING_NAME(VK_ERROR_INITIALIZATION_FAILED);
    LAPWING_NAME(VK_ERROR_DEVICE_LOST);
    LAPWING_NAME(VK_ERROR_MEMORY_MAP_FAILED);
    LAPWING_NAME(VK_ERROR_LAYER_NOT_PRESENT);
    LAPWING_NAME(VK_ERROR_EXTENSION_NOT_PRESENT);
    LAPWING_NAME(VK_ERROR_FEATURE_NOT_PRESENT);
    LAPWING_NAME(VK_ERROR_INCOMPATIBLE_DRIVER);
    LAPWING_NAME(VK_ERROR_TOO_MANY_OBJECTS);
    LAPWING_NAME(VK_ERROR_FORMAT_NOT_SUPPORTED);
    LAPWING_NAME(VK_ERROR_SURFACE_LOST_KHR);
    LAPWING_NAME(VK_ERROR_NATIVE_WINDOW_IN_USE_KHR);
    LAPWING_NAME(VK_ERROR_OUT_OF_DATE_KHR);
    default:
      return "VkResult " + std::to_string(static_cast<int>(result));
  }
#undef LAPWING_NAME
}

void check_result(VkResult result, const char* call, const std::string& where) {
  if (result >= VK_SUCCESS) return;
  const std::string message =
      std::string(call) + " failed on " + where + ": " + result_name(result) + next_step(result);
  if (result == VK_ERROR_DEVICE_LOST) throw DeviceLost(message);
  throw GpuError(message);
}

}  // namespace lapwing::gpu
