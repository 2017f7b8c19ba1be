#pragma once

#include <volk.h>

namespace lapwing::gpu {

/// Returns a Vulkan structure of the given type, otherwise zero, followed by `next`.
template <typename T>
T structure(VkStructureType type, void* next = nullptr) {
  T value{};
  value.sType = type;
  value.pNext = next;
  return value;
}

}  // namespace lapwing::gpu
