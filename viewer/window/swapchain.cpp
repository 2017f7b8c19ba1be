#include "window/swapchain.h"

#include <algorithm>
#include <limits>

#include "lapwing/base/errors.h"
#include "lapwing/gpu/context.h"
#include "lapwing/gpu/results.h"
#include "window/window.h"

namespace lapwing::viewer {
namespace {

// Limits the wait for an image, because a desktop that does not show the window returns none.
constexpr std::uint64_t kLongestWaitNanoseconds = 1'000'000'000;

// Returns whether the image can be used, even if the swapchain is suboptimal.
bool usable(VkResult result) {
  return result == VK_SUCCESS || result == VK_SUBOPTIMAL_KHR;
}

VkExtent2D fitting_extent(VkExtent2D pixels, const VkSurfaceCapabilitiesKHR& can) {
  constexpr std::uint32_t kAsTheImagesAre = std::numeric_limits<std::uint32_t>::max();
  if (can.currentExtent.width != kAsTheImagesAre) return can.currentExtent;
  if (pixels.width == 0 || pixels.height == 0) return {0, 0};
  return {std::clamp(pixels.width, can.minImageExtent.width, can.maxImageExtent.width),
          std::clamp(pixels.height, can.minImageExtent.height, can.maxImageExtent.height)};
}

VkSemaphore make_semaphore(const gpu::Context& context) {
  const VkSemaphoreCreateInfo info{VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
  VkSemaphore semaphore = VK_NULL_HANDLE;
  context.check(context.vk().vkCreateSemaphore(context.device(), &info, nullptr, &semaphore),
                "vkCreateSemaphore");
  return semaphore;
}

}  // namespace

Swapchain::Swapchain(gpu::Context& context, const Window& window)
    : context_(context), surface_(window.create_surface(context.instance())) {
  try {
    check_support();
    choose_format();
    ready_ = make_semaphore(context);
  } catch (...) {
    release();
    throw;
  }
}

Swapchain::~Swapchain() {
  release();
}

void Swapchain::release() noexcept {
  context_.wait_idle();
  destroy_views();
  const auto& vk = context_.vk();
  for (const VkSemaphore semaphore : drawn_) {
    vk.vkDestroySemaphore(context_.device(), semaphore, nullptr);
  }
  vk.vkDestroySemaphore(context_.device(), ready_, nullptr);
  if (handle_ != VK_NULL_HANDLE) vk.vkDestroySwapchainKHR(context_.device(), handle_, nullptr);
  vkDestroySurfaceKHR(context_.instance(), surface_, nullptr);
}

void Swapchain::check(VkResult result, const char* call) const {
  if (result == VK_ERROR_SURFACE_LOST_KHR) {
    throw SurfaceLost(std::string(call) + ": the window surface was lost");
  }
  context_.check(result, call);
}

void Swapchain::check_support() const {
  VkBool32 supported = VK_FALSE;
  check(vkGetPhysicalDeviceSurfaceSupportKHR(context_.physical_device(), context_.queue_family(),
                                             surface_, &supported),
        "vkGetPhysicalDeviceSurfaceSupportKHR");
  if (supported != VK_FALSE) return;
  throw GpuError(context_.description().name +
                 " cannot draw on this desktop; choose another device with --device (`lapwing "
                 "info` lists them)");
}

void Swapchain::choose_format() {
  std::uint32_t count = 0;
  check(vkGetPhysicalDeviceSurfaceFormatsKHR(context_.physical_device(), surface_, &count, nullptr),
        "vkGetPhysicalDeviceSurfaceFormatsKHR");
  std::vector<VkSurfaceFormatKHR> formats(count);
  check(vkGetPhysicalDeviceSurfaceFormatsKHR(context_.physical_device(), surface_, &count,
                                             formats.data()),
        "vkGetPhysicalDeviceSurfaceFormatsKHR");
  for (const VkSurfaceFormatKHR& format : formats) {
    if (format.colorSpace != VK_COLOR_SPACE_SRGB_NONLINEAR_KHR) continue;
    if (format.format != VK_FORMAT_B8G8R8A8_SRGB && format.format != VK_FORMAT_R8G8B8A8_SRGB) {
      continue;
    }
    format_ = format;
    return;
  }
  throw GpuError("The desktop does not support sRGB images of " + context_.description().name +
                 "; choose another device with --device (`lapwing info` lists them)");
}

bool Swapchain::resize(VkExtent2D pixels) {
  VkSurfaceCapabilitiesKHR can;
  check(vkGetPhysicalDeviceSurfaceCapabilitiesKHR(context_.physical_device(), surface_, &can),
        "vkGetPhysicalDeviceSurfaceCapabilitiesKHR");
  // CachedPicture::record_copy copies the image of the scene into the swapchain's images.
  if ((can.supportedUsageFlags & VK_IMAGE_USAGE_TRANSFER_DST_BIT) == 0) {
    throw GpuError("The desktop does not allow images of " + context_.description().name +
                   " to be copied to its windows; choose another device with --device (`lapwing "
                   "info` lists them)");
  }
  destroy_views();
  extent_ = fitting_extent(pixels, can);
  if (extent_.width == 0 || extent_.height == 0) return false;
  create_images(extent_, can);
  return true;
}

void Swapchain::create_images(VkExtent2D pixels, const VkSurfaceCapabilitiesKHR& can) {
  const auto& vk = context_.vk();
  VkSwapchainCreateInfoKHR info{VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR};
  info.surface = surface_;
  info.minImageCount = can.minImageCount + 1;
  if (can.maxImageCount != 0) info.minImageCount = std::min(info.minImageCount, can.maxImageCount);
  info.imageFormat = format_.format;
  info.imageColorSpace = format_.colorSpace;
  info.imageExtent = pixels;
  info.imageArrayLayers = 1;
  info.imageUsage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  info.preTransform = can.currentTransform;
  info.compositeAlpha = (can.supportedCompositeAlpha & VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR) != 0
                            ? VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR
                            : VK_COMPOSITE_ALPHA_INHERIT_BIT_KHR;
  info.presentMode = VK_PRESENT_MODE_FIFO_KHR;
  info.clipped = VK_TRUE;
  info.oldSwapchain = handle_;
  VkSwapchainKHR made = VK_NULL_HANDLE;
  check(vk.vkCreateSwapchainKHR(context_.device(), &info, nullptr, &made), "vkCreateSwapchainKHR");
  if (handle_ != VK_NULL_HANDLE) vk.vkDestroySwapchainKHR(context_.device(), handle_, nullptr);
  handle_ = made;

  std::uint32_t count = 0;
  context_.check(vk.vkGetSwapchainImagesKHR(context_.device(), handle_, &count, nullptr),
                 "vkGetSwapchainImagesKHR");
  images_.resize(count);
  context_.check(vk.vkGetSwapchainImagesKHR(context_.device(), handle_, &count, images_.data()),
                 "vkGetSwapchainImagesKHR");
  for (const VkImage image : images_) {
    VkImageViewCreateInfo view{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    view.image = image;
    view.viewType = VK_IMAGE_VIEW_TYPE_2D;
    view.format = format_.format;
    view.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    context_.check(vk.vkCreateImageView(context_.device(), &view, nullptr, &views_.emplace_back()),
                   "vkCreateImageView");
    if (drawn_.size() < views_.size()) drawn_.push_back(make_semaphore(context_));
  }
}

void Swapchain::destroy_views() {
  for (const VkImageView view : views_) {
    context_.vk().vkDestroyImageView(context_.device(), view, nullptr);
  }
  views_.clear();
  images_.clear();
}

std::optional<Screen::Image> Swapchain::acquire() {
  if (images_.empty()) return {};
  std::uint32_t index = 0;
  const VkResult result = context_.vk().vkAcquireNextImageKHR(
      context_.device(), handle_, kLongestWaitNanoseconds, ready_, VK_NULL_HANDLE, &index);
  if (result == VK_ERROR_OUT_OF_DATE_KHR || result == VK_TIMEOUT || result == VK_NOT_READY) {
    return {};
  }
  if (!usable(result)) check(result, "vkAcquireNextImageKHR");
  return Image{index, images_[index], views_[index], ready_, drawn_[index]};
}

ImageState Swapchain::shown() const {
  return {VK_IMAGE_LAYOUT_PRESENT_SRC_KHR, VK_PIPELINE_STAGE_2_NONE, VK_ACCESS_2_NONE};
}

bool Swapchain::present(const Image& image) {
  VkPresentInfoKHR info{VK_STRUCTURE_TYPE_PRESENT_INFO_KHR};
  info.waitSemaphoreCount = 1;
  info.pWaitSemaphores = &image.drawn;
  info.swapchainCount = 1;
  info.pSwapchains = &handle_;
  info.pImageIndices = &image.index;
  const VkResult result = context_.present(info);
  if (result == VK_ERROR_OUT_OF_DATE_KHR || result == VK_SUBOPTIMAL_KHR) return false;
  check(result, "vkQueuePresentKHR");
  return true;
}

}  // namespace lapwing::viewer
