#include "window/frame_painter.h"

#include <array>
#include <imgui.h>

#include "lapwing/gpu/context.h"
#include "lapwing/gpu/recorder.h"

namespace lapwing::viewer {
namespace {

constexpr std::uint32_t kSamples = 4;

// Timestamps of a frame.
enum Moment : std::uint32_t { kBegun, kSurfaceDrawn, kPanelsDrawn, kMomentCount };

// A new image is waited for where it is first written: submissions wait for `ready` there.
constexpr ImageState kAcquired{VK_IMAGE_LAYOUT_UNDEFINED,
                               VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT, VK_ACCESS_2_NONE};
constexpr ImageState kShown{VK_IMAGE_LAYOUT_PRESENT_SRC_KHR, VK_PIPELINE_STAGE_2_NONE,
                            VK_ACCESS_2_NONE};

VkSemaphoreSubmitInfo at_stage(VkSemaphore semaphore, VkPipelineStageFlags2 stage) {
  VkSemaphoreSubmitInfo info{VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO};
  info.semaphore = semaphore;
  info.stageMask = stage;
  return info;
}

}  // namespace

FramePainter::FramePainter(gpu::Context& context, VkSurfaceKHR surface)
    : context_(context),
      swapchain_(context, surface),
      format_{.color = swapchain_.format(), .samples = sample_count(context, kSamples)},
      renderer_(context, format_),
      ui_(context, format_.color),
      commands_(context, "frame", kMomentCount),
      ready_(make_semaphore(context)) {}

FramePainter::~FramePainter() {
  context_.wait_idle();
  context_.vk().vkDestroySemaphore(context_.device(), ready_, nullptr);
}

void FramePainter::finish_frame(FrameTimings& timings) {
  commands_.wait();
  if (!timed_) return;
  timings.draw_ms = commands_.milliseconds_between(kBegun, kSurfaceDrawn);
  timings.ui_ms = commands_.milliseconds_between(kSurfaceDrawn, kPanelsDrawn);
  timed_ = false;
}

void FramePainter::fit_to(VkExtent2D pixels) {
  if (!outdated_ && pixels.width == fitted_.width && pixels.height == fitted_.height) return;
  scope_.reset();
  fitted_ = pixels;
  outdated_ = !swapchain_.resize(pixels);
  if (!outdated_) scope_.emplace(context_, swapchain_.extent(), format_);
}

bool FramePainter::paint(VkExtent2D pixels, const Scene& scene, const ImDrawData& panels) {
  fit_to(pixels);
  if (outdated_) return false;
  const auto image = swapchain_.acquire(ready_);
  if (!image) {
    outdated_ = true;
    return false;
  }
  ui_.take(panels);
  record(*image, scene, panels);
  const std::array waits{at_stage(ready_, kAcquired.stages)};
  const std::array signals{at_stage(image->drawn, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT)};
  commands_.submit(waits, signals);
  timed_ = true;
  outdated_ = !swapchain_.present(*image);
  return !outdated_;
}

void FramePainter::record(const Swapchain::Image& image, const Scene& scene,
                          const ImDrawData& panels) {
  const VkExtent2D extent = swapchain_.extent();
  gpu::Recorder recorder(commands_);
  const VkCommandBuffer commands = recorder.handle();
  recorder.timestamp();
  swapchain_.transition(commands, image, kAcquired, kColorTarget);
  scope_->begin(commands, image.view);
  renderer_.begin(commands, extent, scene.background);
  if (scene.surface != nullptr) {
    renderer_.draw(commands, extent, *scene.surface, *scene.paint, scene.camera, scene.style);
  }
  scope_->end(commands);
  recorder.timestamp();

  // Panels have straight edges and antialiased texts: one sample is enough for them.
  swapchain_.transition(commands, image, kColorTarget, kColorTarget);
  VkRenderingAttachmentInfo color{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
  color.imageView = image.view;
  color.imageLayout = kColorTarget.layout;
  color.loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;
  color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  VkRenderingInfo scope{VK_STRUCTURE_TYPE_RENDERING_INFO};
  scope.renderArea = {{0, 0}, extent};
  scope.layerCount = 1;
  scope.colorAttachmentCount = 1;
  scope.pColorAttachments = &color;
  context_.vk().vkCmdBeginRendering(commands, &scope);
  ui_.draw(commands, extent, panels);
  context_.vk().vkCmdEndRendering(commands);
  swapchain_.transition(commands, image, kColorTarget, kShown);
  recorder.timestamp();
  recorder.finish();
}

}  // namespace lapwing::viewer
