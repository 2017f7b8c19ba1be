#pragma once

#include <string>

#include <volk.h>

namespace lapwing::gpu {

/// "VK_ERROR_DEVICE_LOST", or the number of a result without a name here.
std::string result_name(VkResult result);

/// Throws GpuError "CALL failed on WHERE: RESULT" with the next step, unless `result` is a success;
/// DeviceLost where it says so.
void check_result(VkResult result, const char* call, const std::string& where);

}  // namespace lapwing::gpu
