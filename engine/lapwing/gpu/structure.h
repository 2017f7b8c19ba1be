#pragma once

#include <volk.h>

namespace lapwing::gpu {

/// A Vulkan structure of the given type, all else zero, followed by `next`.
template <typename T>
T structure(VkStructureType type, void* next = nullptr) {
  T value{};
  value.sType = type;
  value.pNext = next;
  return value;
}

}  // namespace lapwing::gpu
