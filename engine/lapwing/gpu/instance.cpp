#include "lapwing/gpu/instance.h"

#include <cstdlib>
#include <dlfcn.h>
#include <mutex>
#include <set>

#include "lapwing/base/errors.h"
#include "lapwing/gpu/results.h"
#include "lapwing/gpu/validation.h"

namespace lapwing::gpu {
namespace {

constexpr const char* kInstall =
    "install a graphics driver with Vulkan 1.3 (mesa-vulkan-drivers has one that needs no GPU), or "
    "run with --device cpu";

std::string loader_file() {
  const char* file = std::getenv("LAPWING_VULKAN_LOADER");
  return file != nullptr && *file != '\0' ? file : "libvulkan.so.1";
}

[[noreturn]] void throw_no_loader(const std::string& file, const std::string& reason) {
  throw GpuError("no Vulkan loader: cannot use " + file + " (" + reason +
                 "); install libvulkan1 and mesa-vulkan-drivers, or run with --device cpu");
}

std::string last_dl_error() {
  const char* text = dlerror();
  return text != nullptr ? text : "unknown error";
}

// Creates an additional instance for each loader and never destroys it. A driver is unloaded with
// its last instance, and reloading may fail: NVIDIA's driver 580 took half a second each time, and
// was no longer found after about thirty times.
void keep_drivers(const VkInstanceCreateInfo& info) {
  static std::mutex mutex;
  static std::set<std::string> kept;
  const std::lock_guard lock(mutex);
  if (!kept.insert(loader_file()).second) return;
  VkInstanceCreateInfo bare = info;
  bare.pNext = nullptr;
  bare.enabledLayerCount = 0;
  bare.enabledExtensionCount = 0;
  VkInstance instance = VK_NULL_HANDLE;
  if (vkCreateInstance(&bare, nullptr, &instance) != VK_SUCCESS) return;
  const auto enumerate = reinterpret_cast<PFN_vkEnumeratePhysicalDevices>(
      vkGetInstanceProcAddr(instance, "vkEnumeratePhysicalDevices"));
  std::uint32_t count = 0;
  enumerate(instance, &count, nullptr);
}

}  // namespace

void open_loader() {
  const std::string file = loader_file();
  // Never closed, because threads and thread-local data of drivers outlive an instance.
  void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) throw_no_loader(file, last_dl_error());
  const auto entry =
      reinterpret_cast<PFN_vkGetInstanceProcAddr>(dlsym(library, "vkGetInstanceProcAddr"));
  if (entry == nullptr) throw_no_loader(file, last_dl_error());
  volkInitializeCustom(entry);
  const std::uint32_t version = volkGetInstanceVersion();
  if (version < VK_API_VERSION_1_3) {
    throw_no_loader(file, "it supports Vulkan " + std::to_string(VK_API_VERSION_MAJOR(version)) +
                              "." + std::to_string(VK_API_VERSION_MINOR(version)) + ", not 1.3");
  }
}

VkInstance create_instance(std::span<const char* const> extensions, const Validation* validation) {
  VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
  application.pApplicationName = "lapwing";
  application.apiVersion = VK_API_VERSION_1_3;

  std::vector<const char*> enabled(extensions.begin(), extensions.end());
  const char* layer = Validation::layer();
  VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
  info.pApplicationInfo = &application;
  if (validation != nullptr) {
    const auto more = Validation::instance_extensions();
    enabled.insert(enabled.end(), more.begin(), more.end());
    info.pNext = validation->instance_chain();
    info.enabledLayerCount = 1;
    info.ppEnabledLayerNames = &layer;
  }
  info.enabledExtensionCount = static_cast<std::uint32_t>(enabled.size());
  info.ppEnabledExtensionNames = enabled.data();

  VkInstance instance = VK_NULL_HANDLE;
  const VkResult result = vkCreateInstance(&info, nullptr, &instance);
  if (result == VK_ERROR_INCOMPATIBLE_DRIVER) {
    throw GpuError("the Vulkan loader " + loader_file() + " finds no driver; " + kInstall);
  }
  check_result(result, "vkCreateInstance", "the Vulkan loader");
  keep_drivers(info);
  volkLoadInstanceOnly(instance);
  return instance;
}

}  // namespace lapwing::gpu
