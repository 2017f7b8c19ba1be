#pragma once

#include <string>

#include <volk.h>

namespace lapwing::gpu {

/// Returns the name of a result, "VK_ERROR_DEVICE_LOST", or its number if it has no name here.
std::string result_name(VkResult result);

/// Throws GpuError "CALL failed on WHERE: RESULT" with the next step, unless `result` is a success.
/// Throws DeviceLost if it is VK_ERROR_DEVICE_LOST.
void check_result(VkResult result, const char* call, const std::string& where);

}  // namespace lapwing::gpu
