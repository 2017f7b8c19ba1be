#pragma once

#include <string>

#include <volk.h>

namespace lapwing::gpu {

/// Returns the name of a result, for example "VK_ERROR_DEVICE_LOST", or its number if the name is
/// unknown.
std::string result_name(VkResult result);

/// Throws GpuError if `result` is an error. The message is "CALL failed on WHERE: RESULT", followed
/// by the next step for the user. If `result` is VK_ERROR_DEVICE_LOST, throws DeviceLost.
void check_result(VkResult result, const char* call, const std::string& where);

}  // namespace lapwing::gpu
