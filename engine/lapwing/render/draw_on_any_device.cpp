#include "lapwing/render/draw_on_any_device.h"

#include <algorithm>
#include <exception>
#include <utility>
#include <vector>

#include "lapwing/base/errors.h"
#include "lapwing/gpu/context.h"

namespace lapwing {
namespace {

std::shared_ptr<gpu::Context> open(const std::string& device) {
  return std::make_shared<gpu::Context>(gpu::ContextOptions{.device = device});
}

// Returns the names of usable devices, starting with the device of index `failed`.
std::vector<std::string> devices_from(std::size_t failed) {
  std::vector<gpu::DeviceDescription> all = gpu::list_devices();
  std::erase_if(all, [](const gpu::DeviceDescription& device) { return !device.rejected.empty(); });
  std::stable_partition(all.begin(), all.end(), [&](const gpu::DeviceDescription& device) {
    return device.index == failed;
  });
  std::vector<std::string> names;
  for (const gpu::DeviceDescription& device : all) names.push_back(std::to_string(device.index));
  return names;
}

}  // namespace

std::string draw_on_any_device(
    std::shared_ptr<gpu::Context> first,
    const std::function<void(const std::shared_ptr<gpu::Context>&)>& draw) {
  std::exception_ptr failure;
  std::string why;
  std::size_t failed = 0;
  try {
    if (first == nullptr) first = open("auto");
    failed = first->description().index;
    draw(first);
    return {};
  } catch (const GpuError& error) {
    failure = std::current_exception();
    why = error.what();
  }
  first.reset();  // frees its memory, because the error may be a lack of memory
  try {
    for (const std::string& name : devices_from(failed)) {
      try {
        const auto context = open(name);
        draw(context);
        return "the device failed, and " + context->description().name +
               " drew the picture: " + why;
      } catch (const GpuError&) {
        continue;  // the caller gets the first error
      }
    }
  } catch (const GpuError&) {
    // The devices cannot be listed; report the first error.
  }
  std::rethrow_exception(failure);
}

}  // namespace lapwing
