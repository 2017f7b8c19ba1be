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

/// The source of the scene's image in a frame.
enum class PictureSource {
  keep,   ///< shows the cached image
  quick,  ///< renders it without antialiasing, and at a lower resolution if that takes too long
  fine,   ///< renders it in full quality
};

/// The conditions that determine the PictureSource.
struct PictureNeed {
  bool changed = true;             ///< the scene has changed since the cached image was rendered
  bool only_view_changed = false;  ///< only the cameras differ
  bool is_quick = false;           ///< the cached image was rendered in quick quality
  bool moving = false;             ///< Scene::moving
  bool at_rest = false;            ///< nothing in the scene has changed for a while
  bool fine_is_slow = false;       ///< a fine image takes too long while something moves
};

/// Returns whether to reuse the cached image or to render a new one, and in which quality. Changed
/// contents are rendered in quick quality if a fine image is slow, and either something moves or
/// only the camera has changed. Otherwise they are rendered in fine quality. If nothing has changed
/// for a while, a fine image replaces a cached quick image.
PictureSource picture_way(const PictureNeed& need);

/// Chooses the resolution of quick images. If frames take too long, lowers it by as much as their
/// time requires, assuming that the time is proportional to the number of pixels. Raises it again
/// in small steps if frames would then still be fast enough. The next motion begins with the last
/// resolution.
class MovingResolution {
 public:
  /// Longest time of a frame on the device in milliseconds. Users notice longer frames.
  static constexpr double kLongestFrame = 50.0;
  /// Largest value of `pixels_per_pixel`.
  static constexpr double kCoarsest = 2.0;

  /// Returns the width and height, in window pixels, of one rendered pixel: a multiple of a
  /// quarter.
  double pixels_per_pixel() const { return pixels_; }

  /// Reports the time of a frame at this resolution.
  void took(double milliseconds);

 private:
  double pixels_ = 1.0;
  int slow_ = 0;  ///< number of consecutive frames that took too long
  int fast_ =
      0;  ///< number of consecutive frames that would be fast enough at the next finer resolution
  /// The value of fast_ at which the resolution is raised. It doubles whenever the resolution is
  /// lowered. This prevents oscillation if the time depends mainly on the number of triangles.
  int patience_ = 4;
};

/// Identifies the contents of a rendered image: cameras, styles, grid, background, and the
/// revisions of surfaces, carried objects and their colours. Does not include the quality
/// (`Scene::moving`, `SurfaceStyle::sides`), or panels and marks, which are drawn over the image.
class SceneContents {
 public:
  /// Stores the contents of `scene`. Allocates memory only if the number of carried objects grows.
  void take(const Scene& scene);

  bool operator==(const SceneContents&) const = default;
  /// Returns whether the contents differ, but only in the cameras.
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
  struct Left {
    Seen seen;
    double width = 0.0;

    bool operator==(const Left&) const = default;
  };

  Seen main_;
  std::vector<std::uint64_t> carried_;
  std::optional<GroundGrid> grid_;
  std::optional<Left> left_;
  std::optional<Seen> beside_;
  Eigen::Vector2d corner_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d size_ = Eigen::Vector2d::Zero();
  Background background_ = Background::gradient;
};

/// Options for benchmarks and tests. The window uses the defaults.
struct PaintingOptions {
  bool keeps_pictures = true;  ///< whether to reuse the cached image
  /// Width and height, in window pixels, of one rendered pixel while something moves, in quick
  /// quality. If not set, the frame times determine quality and resolution.
  std::optional<double> moving_pixels;
  Renderer::Pipelines pipelines = Renderer::Pipelines::by_style;
};

/// Renders a scene into an image, reuses the image in later frames, and copies it under the panels.
/// The context must outlive it. Before each call, the device must have finished the last frame.
class CachedPicture {
 public:
  CachedPicture(gpu::Context& context, VkFormat color, const PaintingOptions& options);

  /// Sets the size of frames. Releases the images if it changes.
  void resize(VkExtent2D extent);

  /// Returns the source of the image for the next frame, which shows `scene`.
  PictureSource choose(const Scene& scene, bool at_rest);
  /// Renders the image, unless `way` is `keep`. Must be called outside a rendering scope.
  void record(VkCommandBuffer commands, const Scene& scene, PictureSource way);
  /// Copies the image to `target`, whose layout must be that of kCopyTarget. Scales an image of
  /// lower resolution up.
  void record_copy(VkCommandBuffer commands, VkImage target) const;
  /// Reports the device time of the last frame, whose image had the source `way`.
  void took(PictureSource way, double milliseconds);

  /// Returns whether the image was rendered in quick quality.
  bool is_quick() const { return shown_ == &quick_; }
  /// Returns the width and height, in window pixels, of one pixel of the image.
  double pixels_per_pixel() const { return shown_ != nullptr ? shown_->pixels : 1.0; }

 private:
  /// An image with a fixed number of samples per pixel.
  struct Drawing {
    Drawing(gpu::Context& context, VkFormat color, std::uint32_t samples,
            Renderer::Pipelines pipelines);

    TargetFormat format;
    Renderer renderer;
    double pixels = 1.0;       ///< width and height, in window pixels, of one pixel of the image
    VkExtent2D extent{};       ///< size of the image
    std::optional<DeviceImage> image;
    std::optional<DrawScope> scope;
  };

  /// Marks the image as invalid, so that the next frame renders it.
  void forget() { shown_ = nullptr; }
  void fit(Drawing& drawing, double pixels) const;
  void draw_surfaces(VkCommandBuffer commands, const Drawing& drawing, const Scene& scene,
                     const SurfaceStyle& style) const;
  void draw_beside(VkCommandBuffer commands, const Drawing& drawing, const SideScene& scene,
                   Background background) const;

  gpu::Context& context_;
  PaintingOptions options_;
  VkExtent2D extent_{};
  Drawing fine_;
  Drawing quick_;
  const Drawing* shown_ = nullptr;  ///< the last rendered image; null if it is invalid
  SceneContents contents_;          ///< contents of *shown_
  SceneContents next_;              ///< contents of the last argument of `choose`
  MovingResolution resolution_;
  double fine_ms_ = 0.0;  ///< time of the last fine frame
};

/// State of an image that is the target of a copy.
inline constexpr ImageState kCopyTarget{VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                                        VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                                        VK_ACCESS_2_TRANSFER_WRITE_BIT};

}  // namespace lapwing::viewer
