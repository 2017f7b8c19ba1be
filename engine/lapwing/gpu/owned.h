#pragma once

#include <utility>

#include "lapwing/gpu/context.h"

namespace lapwing::gpu {

/// Owns a Vulkan object and destroys it. The context must outlive the owner. A default-constructed
/// owner is null.
template <typename Handle>
class Owned {
 public:
  using Destroy = void(VKAPI_PTR*)(VkDevice, Handle, const VkAllocationCallbacks*);

  Owned() = default;
  Owned(const Context& context, Handle handle, Destroy destroy)
      : device_(context.device()), handle_(handle), destroy_(destroy) {}
  ~Owned() {
    if (handle_ != VK_NULL_HANDLE) destroy_(device_, handle_, nullptr);
  }
  Owned(Owned&& other) noexcept { *this = std::move(other); }
  Owned& operator=(Owned&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(handle_, other.handle_);
    std::swap(destroy_, other.destroy_);
    return *this;
  }

  Handle get() const { return handle_; }

 private:
  VkDevice device_ = VK_NULL_HANDLE;
  Handle handle_ = VK_NULL_HANDLE;
  Destroy destroy_ = nullptr;
};

/// Creates an object by calling `make`, for example vkCreateBuffer. Throws GpuError if the call
/// fails; the message contains `call`.
template <typename Handle, typename Info>
Owned<Handle> create(const Context& context,
                     VkResult(VKAPI_PTR* make)(VkDevice, const Info*, const VkAllocationCallbacks*,
                                               Handle*),
                     typename Owned<Handle>::Destroy destroy, const Info& info, const char* call) {
  Handle handle = VK_NULL_HANDLE;
  context.check(make(context.device(), &info, nullptr, &handle), call);
  return {context, handle, destroy};
}

}  // namespace lapwing::gpu
