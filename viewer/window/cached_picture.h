#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lapwing/gpu/recorder.h"
#include "lapwing/render/device_image.h"
#include "lapwing/render/draw_scope.h"
#include "lapwing/render/renderer.h"
#include "window/app.h"

namespace lapwing::viewer {

/// Where the image of the scene in a frame comes from.
enum class PictureSource {
  keep,   ///< shows the cached image
  quick,  ///< renders it without antialiasing, and at a lower resolution if that takes too long
  fine,   ///< renders it in full quality
};

/// The conditions that determine the PictureSource.
struct PictureNeed {
  bool changed = true;             ///< the scene has changed since the cached image was rendered
  bool only_view_changed = false;  ///< only the cameras differ
  bool is_quick = false;           ///< the cached image has quick quality
  bool moving = false;             ///< Scene::moving
  bool at_rest = false;            ///< nothing in the scene has changed for a while
  bool fine_is_slow = false;       ///< a fine image takes longer than kLongestFrame
};

/// Returns whether to reuse the cached image or to render it in quick or fine quality. Changed
/// contents are rendered in quick quality while something moves. This also applies if only the
/// camera has changed and a fine image is slow. Otherwise they are rendered in fine quality. Once
/// the scene has been at rest for a while, a fine image replaces a cached quick one.
PictureSource picture_way(const PictureNeed& need);

/// Chooses the resolution while something moves. Lowers it if frames take too long, and raises it
/// again if they take much less time. The next motion begins with the last resolution.
class MovingResolution {
 public:
  /// In milliseconds on the device. A longer frame is noticeable.
  static constexpr double kLongestFrame = 50.0;
  /// Most window pixels, across and down, per pixel drawn.
  static constexpr std::uint32_t kCoarsest = 2;

  /// Window pixels, across and down, per pixel drawn.
  std::uint32_t pixels_per_pixel() const { return pixels_; }

  /// Reports the time of a frame at this resolution.
  void took(double milliseconds);

 private:
  std::uint32_t pixels_ = 1;
  int slow_ = 0;  ///< frames in a row that took too long
  int fast_ = 0;  ///< frames in a row with time to spare
  /// The value of fast_ at which the resolution is raised. It doubles whenever the resolution is
  /// lowered. This prevents oscillation if the number of triangles, not pixels, determines the
  /// time.
  int patience_ = 4;
};

/// Identifies the contents of a rendered image: cameras, styles, background, and the revisions of
/// surfaces, carried objects and their colours. Does not include the quality (`Scene::moving`,
/// `SurfaceStyle::sides`) or what is drawn over the image, such as panels and marks.
class SceneContents {
 public:
  /// Takes the contents of `scene`. Allocates nothing if as much is carried as before.
  void take(const Scene& scene);

  bool operator==(const SceneContents&) const = default;
  /// Whether only the cameras differ.
  bool differs_in_view_alone(const SceneContents& other) const;

 private:
  struct Seen {
    std::uint64_t surface = 0;
    std::uint64_t paint = 0;
    Camera camera;
    SurfaceStyle style;

    bool operator==(const Seen&) const = default;
  };
  static Seen seen(const SurfaceScene& scene);

  Seen main_;
  std::vector<std::uint64_t> carried_;
  std::optional<Seen> beside_;
  Eigen::Vector2d corner_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d size_ = Eigen::Vector2d::Zero();
  Background background_ = Background::gradient;
};

/// Options for benchmarks and tests. The window uses the defaults.
struct PaintingOptions {
  bool keeps_pictures = true;
  /// Window pixels, across and down, per pixel drawn while something moves. By default
  /// MovingResolution chooses them by the frame times.
  std::optional<std::uint32_t> moving_pixels;
  Renderer::Pipelines pipelines = Renderer::Pipelines::by_style;
};

/// Holds the picture of a scene in an image, from one frame to the next, and copies it under the
/// panels. The context must outlive it, and have finished the last frame at every call.
class CachedPicture {
 public:
  CachedPicture(gpu::Context& context, VkFormat color, const PaintingOptions& options);

  /// Sets the size of frames. Releases the images if it changes.
  void resize(VkExtent2D extent);

  /// Returns how the next frame, which shows `scene`, gets its picture.
  PictureSource choose(const Scene& scene, bool at_rest);
  /// Draws the picture in that way, unless it is kept. Must be called outside a rendering scope.
  void record(VkCommandBuffer commands, const Scene& scene, PictureSource way);
  /// Copies the picture to all of `target`, in the layout of kCopyTarget. Enlarges a coarse
  /// picture.
  void record_copy(VkCommandBuffer commands, VkImage target) const;
  /// Reports how long the device took to draw and show the last frame in that way.
  void took(PictureSource way, double milliseconds);

  /// Whether the picture was drawn quickly, so that it will be redrawn at rest.
  bool is_quick() const { return shown_ == &quick_; }
  /// Window pixels, across and down, per pixel of the picture.
  std::uint32_t pixels_per_pixel() const { return shown_ != nullptr ? shown_->pixels : 1; }

 private:
  /// A picture with a certain number of samples per pixel.
  struct Drawing {
    Drawing(gpu::Context& context, VkFormat color, std::uint32_t samples,
            Renderer::Pipelines pipelines);

    TargetFormat format;
    Renderer renderer;
    std::uint32_t pixels = 1;  ///< window pixels per pixel of the picture, across and down
    VkExtent2D extent{};       ///< of the picture
    std::optional<DeviceImage> image;
    std::optional<DrawScope> scope;
  };

  /// Makes the next frame redraw the picture.
  void forget() { shown_ = nullptr; }
  void fit(Drawing& drawing, std::uint32_t pixels) const;
  void draw_beside(VkCommandBuffer commands, const Drawing& drawing, const SideScene& scene,
                   Background background) const;

  gpu::Context& context_;
  PaintingOptions options_;
  VkExtent2D extent_{};
  Drawing fine_;
  Drawing quick_;
  const Drawing* shown_ = nullptr;  ///< the one that was drawn last
  SceneContents contents_;          ///< of *shown_
  SceneContents next_;              ///< of the scene last given to `choose`
  MovingResolution resolution_;
  double fine_ms_ = 0.0;  ///< time of the last fine frame
};

/// State of an image that is copied to.
inline constexpr ImageState kCopyTarget{VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                                        VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                                        VK_ACCESS_2_TRANSFER_WRITE_BIT};

}  // namespace lapwing::viewer
