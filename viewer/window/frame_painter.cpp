#include "window/frame_painter.h"

#include <imgui.h>
#include <span>

#include "lapwing/gpu/context.h"
#include "lapwing/gpu/recorder.h"

namespace lapwing::viewer {
namespace {

// The timestamps of a frame, in order.
enum Moment : std::uint32_t {
  kBegun,
  kBlended,
  kNormalsDone,
  kSurfaceDrawn,
  kPanelsDrawn,
  kMomentCount
};

// State of an acquired image. The submission waits for its semaphore `ready` at the transfer stage,
// which is the first to write to the image.
constexpr ImageState kAcquired{VK_IMAGE_LAYOUT_UNDEFINED, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                               VK_ACCESS_2_NONE};

VkSemaphoreSubmitInfo at_stage(VkSemaphore semaphore, VkPipelineStageFlags2 stage) {
  VkSemaphoreSubmitInfo info{VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO};
  info.semaphore = semaphore;
  info.stageMask = stage;
  return info;
}

// Returns the semaphore as a list, empty if it is null.
std::span<const VkSemaphoreSubmitInfo> listed(const VkSemaphoreSubmitInfo& info) {
  return {&info, info.semaphore == VK_NULL_HANDLE ? 0U : 1U};
}

}  // namespace

FramePainter::FramePainter(gpu::Context& context, Screen& screen, const PaintingOptions& options)
    : context_(context),
      screen_(screen),
      picture_(context, screen.format(), options),
      ui_(context, screen.format()),
      commands_(context, "frame", kMomentCount) {}

FramePainter::~FramePainter() {
  context_.wait_idle();
}

void FramePainter::finish_frame(FrameTimings& timings) {
  commands_.wait();
  if (!painted_) return;
  const auto on_device = [&](Moment from, Moment to) {
    return commands_.milliseconds_between(from, to);
  };
  timings.blend_ms = painted_->blend_ms + (moved_ ? on_device(kBegun, kBlended) : 0.0);
  timings.normals_ms = painted_->normals_ms + (moved_ ? on_device(kBlended, kNormalsDone) : 0.0);
  timings.draw_ms = on_device(kNormalsDone, kSurfaceDrawn);
  timings.ui_ms = on_device(kSurfaceDrawn, kPanelsDrawn);
  picture_.took(way_, timings.draw_ms + timings.ui_ms);
  painted_.reset();
}

void FramePainter::fit_to(VkExtent2D pixels) {
  if (!outdated_ && pixels.width == fitted_.width && pixels.height == fitted_.height) return;
  fitted_ = pixels;
  outdated_ = !screen_.resize(pixels);
  if (!outdated_) picture_.resize(screen_.extent());
}

bool FramePainter::paint(VkExtent2D pixels, const Scene& scene, const ImDrawData& panels,
                         bool at_rest) {
  fit_to(pixels);
  if (outdated_) return false;
  const auto image = screen_.acquire();
  if (!image) {
    outdated_ = true;
    return false;
  }
  ui_.take(panels);
  way_ = picture_.choose(scene, at_rest);
  record(*image, scene, panels);
  submit(*image);
  painted_ = scene.surface != nullptr ? scene.surface->take_times() : SurfaceTimes{};
  outdated_ = !screen_.present(*image);
  return !outdated_;
}

void FramePainter::submit(const Screen::Image& image) {
  const VkSemaphoreSubmitInfo ready = at_stage(image.ready, kAcquired.stages);
  const VkSemaphoreSubmitInfo drawn = at_stage(image.drawn, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT);
  commands_.submit(listed(ready), listed(drawn));
}

void FramePainter::record(const Screen::Image& image, const Scene& scene,
                          const ImDrawData& panels) {
  const VkExtent2D extent = screen_.extent();
  gpu::Recorder recorder(commands_);
  const VkCommandBuffer commands = recorder.handle();
  recorder.timestamp();
  if (scene.surface != nullptr) scene.surface->record_blend(recorder);
  recorder.timestamp();
  moved_ = scene.surface != nullptr && scene.surface->record_normals(recorder);
  recorder.timestamp();
  if (scene.left) scene.left->surface->finish();
  if (scene.beside) scene.beside->surface->finish();
  for (const CarriedDrawing& carried : scene.carried) {
    if (carried.surface != nullptr) carried.surface->finish();
  }
  const auto transition = [&](const ImageState& from, const ImageState& to) {
    transition_image(context_, commands, image.handle, VK_IMAGE_ASPECT_COLOR_BIT, from, to);
  };
  picture_.record(commands, scene, way_);
  transition(kAcquired, kCopyTarget);
  picture_.record_copy(commands, image.handle);
  recorder.timestamp();

  // One sample is enough for panels: their edges are straight and their text is antialiased.
  transition(kCopyTarget, kColorTarget);
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
  transition(kColorTarget, screen_.shown());
  recorder.timestamp();
  recorder.finish();
}

}  // namespace lapwing::viewer
