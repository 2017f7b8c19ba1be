#include "window/frame_painter.h"

#include <algorithm>
#include <imgui.h>
#include <span>

#include "lapwing/gpu/context.h"
#include "lapwing/gpu/recorder.h"

namespace lapwing::viewer {
namespace {

constexpr std::uint32_t kFineSamples = 4;

// Timestamps of a frame.
enum Moment : std::uint32_t {
  kBegun,
  kBlended,
  kNormalsDone,
  kSurfaceDrawn,
  kPanelsDrawn,
  kMomentCount
};

// A new image is waited for where it is first written: submissions wait for its `ready` there.
constexpr ImageState kAcquired{VK_IMAGE_LAYOUT_UNDEFINED,
                               VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT, VK_ACCESS_2_NONE};

VkSemaphoreSubmitInfo at_stage(VkSemaphore semaphore, VkPipelineStageFlags2 stage) {
  VkSemaphoreSubmitInfo info{VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO};
  info.semaphore = semaphore;
  info.stageMask = stage;
  return info;
}

// A semaphore, if there is one, as a list.
std::span<const VkSemaphoreSubmitInfo> listed(const VkSemaphoreSubmitInfo& info) {
  return {&info, info.semaphore == VK_NULL_HANDLE ? 0U : 1U};
}

}  // namespace

FramePainter::Drawing::Drawing(gpu::Context& context, VkFormat color, std::uint32_t samples)
    : format{.color = color, .samples = sample_count(context, samples)},
      renderer(context, format) {}

FramePainter::FramePainter(gpu::Context& context, Screen& screen)
    : context_(context),
      screen_(screen),
      fine_(context, screen.format(), kFineSamples),
      quick_(context, screen.format(), 1),
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
  painted_.reset();
}

void FramePainter::fit_to(VkExtent2D pixels) {
  if (!outdated_ && pixels.width == fitted_.width && pixels.height == fitted_.height) return;
  fine_.scope.reset();
  quick_.scope.reset();
  fitted_ = pixels;
  outdated_ = !screen_.resize(pixels);
}

FramePainter::Drawing& FramePainter::drawing_for(const Scene& scene) {
  Drawing& drawing = scene.moving ? quick_ : fine_;
  if (!drawing.scope) drawing.scope.emplace(context_, screen_.extent(), drawing.format);
  return drawing;
}

bool FramePainter::paint(VkExtent2D pixels, const Scene& scene, const ImDrawData& panels) {
  fit_to(pixels);
  if (outdated_) return false;
  const auto image = screen_.acquire();
  if (!image) {
    outdated_ = true;
    return false;
  }
  ui_.take(panels);
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

void FramePainter::draw_beside(VkCommandBuffer commands, const Renderer& renderer,
                               const SideScene& scene, Background background) const {
  const VkExtent2D extent = screen_.extent();
  const auto pixel = [](double place, std::uint32_t limit) {
    return static_cast<std::uint32_t>(std::clamp(place, 0.0, static_cast<double>(limit)));
  };
  const std::uint32_t left = pixel(scene.corner.x(), extent.width);
  const std::uint32_t top = pixel(scene.corner.y(), extent.height);
  const VkRect2D area{
      {static_cast<std::int32_t>(left), static_cast<std::int32_t>(top)},
      {pixel(scene.size.x(), extent.width - left), pixel(scene.size.y(), extent.height - top)}};
  if (area.extent.width == 0 || area.extent.height == 0) return;
  renderer.begin(commands, area, background);
  renderer.draw(commands, area.extent, *scene.surface, *scene.paint, scene.camera, scene.style);
}

void FramePainter::record(const Screen::Image& image, const Scene& scene,
                          const ImDrawData& panels) {
  const VkExtent2D extent = screen_.extent();
  const Drawing& drawing = drawing_for(scene);
  gpu::Recorder recorder(commands_);
  const VkCommandBuffer commands = recorder.handle();
  recorder.timestamp();
  if (scene.surface != nullptr) scene.surface->record_blend(recorder);
  recorder.timestamp();
  moved_ = scene.surface != nullptr && scene.surface->record_normals(recorder);
  recorder.timestamp();
  if (scene.beside) scene.beside->surface->finish();
  for (const CarriedDrawing& carried : scene.carried) {
    if (carried.surface != nullptr) carried.surface->finish();
  }
  const auto transition = [&](const ImageState& from, const ImageState& to) {
    transition_image(context_, commands, image.handle, VK_IMAGE_ASPECT_COLOR_BIT, from, to);
  };
  transition(kAcquired, kColorTarget);
  drawing.scope->begin(commands, image.view);
  drawing.renderer.begin(commands, extent, scene.background);
  if (scene.surface != nullptr) {
    drawing.renderer.draw(commands, extent, *scene.surface, *scene.paint, scene.camera,
                          scene.style);
  }
  for (const CarriedDrawing& carried : scene.carried) {
    drawing.renderer.draw(commands, extent, carried, scene.camera, scene.style);
  }
  if (scene.beside) draw_beside(commands, drawing.renderer, *scene.beside, scene.background);
  drawing.scope->end(commands);
  recorder.timestamp();

  // Panels have straight edges and antialiased texts: one sample is enough for them.
  transition(kColorTarget, kColorTarget);
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
