#include "window/cached_picture.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lapwing/gpu/context.h"
#include "lapwing/render/point_cloud.h"
#include "lapwing/render/surface.h"
#include "lapwing/render/surface_paint.h"

namespace lapwing::viewer {
namespace {

constexpr std::uint32_t kFineSamples = 4;

VkOffset3D corner_of(VkExtent2D extent) {
  return {static_cast<std::int32_t>(extent.width), static_cast<std::int32_t>(extent.height), 1};
}

// Longest time, in milliseconds, of a fine frame while something moves. A smooth motion matters
// more than smooth edges.
constexpr double kLongestFineFrame = 25.0;
constexpr double kStep = 0.25;  // of MovingResolution
// Ignore a single slow frame, which may have compiled a shader or waited for another program.
constexpr int kSlowFrames = 2;
constexpr int kMostPatience = 256;

}  // namespace

PictureSource picture_way(const PictureNeed& need) {
  if (!need.changed) {
    return need.is_quick && need.at_rest ? PictureSource::fine : PictureSource::keep;
  }
  const bool moves = need.moving || need.only_view_changed;
  return moves && need.fine_is_slow ? PictureSource::quick : PictureSource::fine;
}

void MovingResolution::took(double milliseconds) {
  slow_ = milliseconds > kLongestFrame ? slow_ + 1 : 0;
  const double finer = pixels_ - kStep;
  const bool has_time =
      finer >= 1.0 && milliseconds * pixels_ * pixels_ < kLongestFrame * finer * finer;
  fast_ = has_time ? fast_ + 1 : 0;
  if (slow_ >= kSlowFrames && pixels_ < kCoarsest) {
    const double enough = pixels_ * std::sqrt(milliseconds / kLongestFrame);
    pixels_ = std::min(std::ceil(enough / kStep) * kStep, kCoarsest);
    slow_ = 0;
    patience_ = std::min(2 * patience_, kMostPatience);
  } else if (fast_ >= patience_) {
    pixels_ = finer;
    fast_ = 0;
  }
}

SceneContents::Seen SceneContents::seen(const SurfaceScene& scene) {
  Seen all;
  // Without a surface, only the background is visible, which does not depend on the camera.
  if (scene.surface == nullptr) return all;
  all.surface = scene.surface->revision();
  all.paint = scene.paint->revision();
  all.camera = scene.camera;
  all.style = scene.style;
  all.style.sides = Sides::both;
  return all;
}

void SceneContents::take(const Scene& scene) {
  main_ = seen(scene);
  carried_.clear();
  for (const CarriedDrawing& drawing : scene.carried) {
    carried_.push_back(drawing.surface != nullptr ? drawing.surface->revision() : 0);
    carried_.push_back(drawing.paint != nullptr ? drawing.paint->revision() : 0);
    carried_.push_back(drawing.points != nullptr ? drawing.points->revision() : 0);
  }
  grid_ = scene.grid;
  left_.reset();
  if (scene.left) {
    const LeftScene& left = *scene.left;
    left_ = {seen({left.surface, left.paint, {}, left.style}), left.width};
  }
  beside_.reset();
  corner_.setZero();
  size_.setZero();
  if (scene.beside) {
    beside_ = seen(*scene.beside);
    corner_ = scene.beside->corner;
    size_ = scene.beside->size;
  }
  background_ = scene.background;
}

bool SceneContents::differs_in_view_alone(const SceneContents& other) const {
  SceneContents here = *this;
  here.main_.camera = other.main_.camera;
  if (here.beside_ && other.beside_) here.beside_->camera = other.beside_->camera;
  return here == other && *this != other;
}

CachedPicture::Drawing::Drawing(gpu::Context& context, VkFormat color, std::uint32_t samples,
                                Renderer::Pipelines pipelines)
    : format(antialiased(context, color, samples)), renderer(context, format, pipelines) {}

CachedPicture::CachedPicture(gpu::Context& context, VkFormat color, const PaintingOptions& options)
    : context_(context),
      options_(options),
      fine_(context, color, kFineSamples, options.pipelines),
      quick_(context, color, 1, options.pipelines) {}

void CachedPicture::resize(VkExtent2D extent) {
  if (extent.width == extent_.width && extent.height == extent_.height) return;
  extent_ = extent;
  for (Drawing* drawing : {&fine_, &quick_}) {
    drawing->image.reset();
    drawing->scope.reset();
  }
  forget();
}

PictureSource CachedPicture::choose(const Scene& scene, bool at_rest) {
  next_.take(scene);
  const bool has_other = shown_ == nullptr || !options_.keeps_pictures || next_ != contents_;
  return picture_way(
      {.changed = has_other,
       .only_view_changed = shown_ != nullptr && next_.differs_in_view_alone(contents_),
       .is_quick = is_quick(),
       .moving = scene.moving,
       .at_rest = at_rest,
       .fine_is_slow = options_.moving_pixels.has_value() || fine_ms_ > kLongestFineFrame});
}

void CachedPicture::took(PictureSource way, double milliseconds) {
  if (way == PictureSource::fine) fine_ms_ = milliseconds;
  if (way == PictureSource::quick) resolution_.took(milliseconds);
}

void CachedPicture::fit(Drawing& drawing, double pixels) const {
  if (drawing.image && drawing.pixels == pixels) return;
  drawing.image.reset();
  drawing.scope.reset();
  drawing.pixels = pixels;
  const auto rendered = [pixels](std::uint32_t length) {
    return static_cast<std::uint32_t>(std::ceil(length / pixels));
  };
  drawing.extent = {rendered(extent_.width), rendered(extent_.height)};
  drawing.image.emplace(context_, DeviceImageInfo{.name = "picture under the panels",
                                                  .format = drawing.format.color,
                                                  .extent = drawing.extent,
                                                  .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT |
                                                           VK_IMAGE_USAGE_TRANSFER_SRC_BIT});
  drawing.scope.emplace(context_, drawing.extent, drawing.format);
}

void CachedPicture::record(VkCommandBuffer commands, const Scene& scene, PictureSource way) {
  if (way == PictureSource::keep) return;
  forget();  // if an exception is thrown, the image is invalid
  Drawing& drawing = way == PictureSource::fine ? fine_ : quick_;
  fit(drawing, way == PictureSource::fine
                   ? 1.0
                   : options_.moving_pixels.value_or(resolution_.pixels_per_pixel()));
  drawing.image->transition(commands, kDiscarded, kColorTarget);
  drawing.scope->begin(commands, drawing.image->view());
  drawing.renderer.begin(commands, drawing.extent, scene.background);
  // Pass the window's size to `draw`, so that lines and points do not become wider in an image of
  // lower resolution.
  SurfaceStyle style = scene.style;
  style.pixels_per_point /= static_cast<float>(drawing.pixels);
  draw_surfaces(commands, drawing, scene, style);
  if (scene.grid) {
    drawing.renderer.draw(commands, extent_, *scene.grid, scene.camera, style.pixels_per_point);
  }
  if (scene.beside) draw_beside(commands, drawing, *scene.beside, scene.background);
  drawing.scope->end(commands, drawing.image->view());
  drawing.image->transition(commands, kColorTarget, kCopySource);
  shown_ = &drawing;
  std::swap(contents_, next_);
}

void CachedPicture::draw_surfaces(VkCommandBuffer commands, const Drawing& drawing,
                                  const Scene& scene, const SurfaceStyle& style) const {
  const VkRect2D whole{{0, 0}, drawing.extent};
  if (scene.left) {
    const double most = drawing.extent.width;
    const double width = std::clamp(scene.left->width / drawing.pixels, 0.0, most);
    VkRect2D left = whole;
    left.extent.width = static_cast<std::uint32_t>(std::lround(width));
    const VkRect2D right{{static_cast<std::int32_t>(left.extent.width), 0},
                         {whole.extent.width - left.extent.width, whole.extent.height}};
    SurfaceStyle left_style = scene.left->style;
    left_style.pixels_per_point = style.pixels_per_point;
    set_scissor(context_, commands, left);
    drawing.renderer.draw(commands, extent_, *scene.left->surface, *scene.left->paint, scene.camera,
                          left_style);
    set_scissor(context_, commands, right);
  }
  if (scene.surface != nullptr) {
    drawing.renderer.draw(commands, extent_, *scene.surface, *scene.paint, scene.camera, style);
  }
  for (const CarriedDrawing& carried : scene.carried) {
    drawing.renderer.draw(commands, extent_, carried, scene.camera,
                          carried.surface != nullptr ? style : scene.style);
  }
  set_scissor(context_, commands, whole);
}

void CachedPicture::draw_beside(VkCommandBuffer commands, const Drawing& drawing,
                                const SideScene& scene, Background background) const {
  const auto pixel = [&](double place, std::uint32_t limit) {
    return static_cast<std::uint32_t>(
        std::clamp(place / drawing.pixels, 0.0, static_cast<double>(limit)));
  };
  const VkExtent2D all = drawing.extent;
  const std::uint32_t left = pixel(scene.corner.x(), all.width);
  const std::uint32_t top = pixel(scene.corner.y(), all.height);
  const VkRect2D area{
      {static_cast<std::int32_t>(left), static_cast<std::int32_t>(top)},
      {pixel(scene.size.x(), all.width - left), pixel(scene.size.y(), all.height - top)}};
  if (area.extent.width == 0 || area.extent.height == 0) return;
  const auto in_window = [&](std::uint32_t length) {
    return static_cast<std::uint32_t>(std::lround(length * drawing.pixels));
  };
  const VkExtent2D shown{in_window(area.extent.width), in_window(area.extent.height)};
  drawing.renderer.begin(commands, area, background);
  drawing.renderer.draw(commands, shown, *scene.surface, *scene.paint, scene.camera, scene.style);
}

void CachedPicture::record_copy(VkCommandBuffer commands, VkImage target) const {
  constexpr VkImageSubresourceLayers kWhole{VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  const VkImage source = shown_->image->handle();
  if (shown_->pixels == 1.0) {
    VkImageCopy region{kWhole, {}, kWhole, {}, {extent_.width, extent_.height, 1}};
    context_.vk().vkCmdCopyImage(commands, source, kCopySource.layout, target, kCopyTarget.layout,
                                 1, &region);
    return;
  }
  const VkImageBlit region{
      kWhole, {{}, corner_of(shown_->extent)}, kWhole, {{}, corner_of(extent_)}};
  context_.vk().vkCmdBlitImage(commands, source, kCopySource.layout, target, kCopyTarget.layout, 1,
                               &region, VK_FILTER_LINEAR);
}

}  // namespace lapwing::viewer
