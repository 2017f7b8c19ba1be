#pragma once

#include <functional>
#include <memory>

#include "lapwing/vulkan/vulkan_kernels.h"

namespace lapwing::viewer {

/// Makes kernels on the device of `kernels`, with which it may be called on any thread: kernels are
/// one thread's.
std::function<std::unique_ptr<Kernels>()> kernels_like(const VulkanKernels& kernels);

}  // namespace lapwing::viewer
