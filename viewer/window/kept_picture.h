#pragma once

#include <optional>

#include "lapwing/gpu/recorder.h"
#include "lapwing/render/device_image.h"
#include "lapwing/render/draw_scope.h"
#include "lapwing/render/renderer.h"
#include "window/app.h"
#include "window/moving_resolution.h"
#include "window/scene_contents.h"

namespace lapwing::viewer {

/// What a frame does about the picture under the panels.
enum class PictureWay {
  keep,   ///< shows the one that is there
  quick,  ///< draws it without antialiasing, and coarsely where that would take too long
  fine,   ///< draws it as well as it can be
};

/// What that hangs on.
struct PictureNeed {
  bool changed = true;         ///< the scene's contents are not those of the picture
  bool in_view_alone = false;  ///< ...but it is the same seen from elsewhere
  bool is_quick = false;       ///< the picture was drawn quickly
  bool moving = false;         ///< Scene::moving
  bool at_rest = false;        ///< nothing in the scene has changed for a while
  bool fine_is_slow = false;   ///< to draw it finely takes longer than a frame may
};

/// A picture is drawn anew when what it shows has changed: quickly while that moves, and, where
/// antialiasing is slow, when the eye jumps, as with a wheel. Finely again at rest.
PictureWay picture_way(const PictureNeed& need);

/// For measures and tests: as it is by default, the window's.
struct PaintingOptions {
  bool keeps_pictures = true;
  /// Pixels of the window, across and down, for one that is drawn while something moves; without,
  /// as many as frames take time (MovingResolution).
  std::optional<std::uint32_t> moving_pixels;
  Renderer::Pipelines pipelines = Renderer::Pipelines::by_style;
};

/// The picture of a scene in an image of its own, kept from one frame to the next and copied under
/// the panels of each. The context must outlive it, and be done with the last frame at every call.
class KeptPicture {
 public:
  KeptPicture(gpu::Context& context, VkFormat color, const PaintingOptions& options);

  /// For frames of this size. Where it is another one, the images are let go.
  void resize(VkExtent2D extent);

  /// What the next frame, which shows `scene`, is going to do.
  PictureWay choose(const Scene& scene, bool at_rest);
  /// Draws the picture in that way, unless it is kept, outside a rendering scope.
  void record(VkCommandBuffer commands, const Scene& scene, PictureWay way);
  /// Copies it to the whole of `target`, in the layout of kCopyTarget, enlarged if it is coarse.
  void record_copy(VkCommandBuffer commands, VkImage target) const;
  /// How long it took on the device to draw and show the last frame, in that way.
  void took(PictureWay way, double milliseconds);

  /// The next frame draws it anew.
  void forget() { shown_ = nullptr; }
  /// Whether it may be drawn better, and will be at rest.
  bool is_quick() const { return shown_ == &quick_; }
  /// Pixels of the window, across and down, that one pixel drawn stands for.
  std::uint32_t pixels_per_pixel() const { return shown_ != nullptr ? shown_->pixels : 1; }

 private:
  /// What is drawn with so many samples per pixel.
  struct Drawing {
    Drawing(gpu::Context& context, VkFormat color, std::uint32_t samples,
            Renderer::Pipelines pipelines);

    TargetFormat format;
    Renderer renderer;
    std::uint32_t pixels = 1;  ///< of the window for one of the picture's, across and down
    VkExtent2D extent{};       ///< of the picture
    std::optional<DeviceImage> image;
    std::optional<DrawScope> scope;
  };

  void fit(Drawing& drawing, std::uint32_t pixels) const;
  void draw_beside(VkCommandBuffer commands, const Drawing& drawing, const SideScene& scene,
                   Background background) const;

  gpu::Context& context_;
  PaintingOptions options_;
  VkExtent2D extent_{};
  Drawing fine_;
  Drawing quick_;
  const Drawing* shown_ = nullptr;  ///< which of them holds what was drawn last
  SceneContents contents_;          ///< of that
  SceneContents next_;              ///< of the scene that `choose` was asked about
  MovingResolution resolution_;
  double fine_ms_ = 0.0;  ///< what a frame took last that was drawn finely
};

/// How an image is used while it is copied to.
inline constexpr ImageState kCopyTarget{VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                                        VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                                        VK_ACCESS_2_TRANSFER_WRITE_BIT};

}  // namespace lapwing::viewer
