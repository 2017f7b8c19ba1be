#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <volk.h>

#include "lapwing/gpu/buffer.h"
#include "lapwing/render/camera.h"
#include "lapwing/render/color_map.h"
#include "lapwing/render/graphics_pipeline.h"
#include "lapwing/render/overlay.h"
#include "lapwing/render/surface_paint.h"

namespace lapwing {

class PointCloud;
class Surface;

enum class Background { gradient, white, transparent };

enum class SurfaceColor {
  plain,    ///< one light clay
  regions,  ///< by class: outside grey, ROI bluish, belt red, handle yellow
  scalar,   ///< by number, through the colour map
  carried,  ///< one of its own, apart from all of these
};

/// How a surface looks.
struct SurfaceStyle {
  SurfaceColor color = SurfaceColor::plain;
  ColorMap color_map = ColorMap::sequential;
  std::optional<ScalarRange> range;  ///< of the colour map; of the numbers themselves by default
  /// In place of the clay, and under regions in place of the grey outside: what the mesh's file
  /// says, where the paint has that.
  bool file_colors = false;
  bool wireframe = false;  ///< polygon edges over the surface
  bool flat = false;       ///< one normal per triangle
  /// Of a picture for a dense display: what is to be seen whatever the density (edges of the
  /// wireframe, carried points, how far relief is darkened) is as many times as large in pixels.
  float pixels_per_point = 1.0F;
  /// `front` draws faster, and the same picture where no back is seen (see is_closed_outward).
  Sides sides = Sides::both;

  bool operator==(const SurfaceStyle&) const = default;
};

/// What stands with a surface in the same picture: a mesh or points that are carried along with it.
struct CarriedDrawing {
  Surface* surface = nullptr;           ///< null for points
  const SurfacePaint* paint = nullptr;  ///< of the surface
  const PointCloud* points = nullptr;   ///< null for a mesh
};

/// The range that `style` gives the colour map. By default that of the paint's numbers, made
/// symmetric around 0 for a diverging map.
ScalarRange color_range(const SurfaceStyle& style, const SurfacePaint& paint);

/// From places relative to `origin` to Vulkan's clip space in a picture of `extent` pixels. In
/// float64, so that a mesh far from the world's origin keeps its digits.
Eigen::Matrix4d clip_from_surface(const Camera& camera, VkExtent2D extent,
                                  const Eigen::Vector3d& origin);

/// Records draws into a rendering scope (vkCmdBeginRendering) that someone else began, on images
/// that someone else owns: a window's or an OffscreenTarget's. Draws from the buffers of the
/// surface, which on a software device has to be where it is until the commands have run; nothing
/// is copied or uploaded. The context must outlive the renderer, and what is drawn must live until
/// the commands are done.
class Renderer {
 public:
  /// How the pipelines of surfaces are made: one for each way of looking, when it is first drawn,
  /// without what that way leaves out; or one for all of them, as a measure for the others.
  enum class Pipelines { by_style, one };

  /// Throws GpuError when the context's queue has no graphics.
  Renderer(gpu::Context& context, const TargetFormat& target,
           Pipelines pipelines = Pipelines::by_style);

  /// Sets viewport and scissor and fills the picture. First in every scope.
  void begin(VkCommandBuffer commands, VkExtent2D extent, Background background) const;
  /// Begins anew in a part of the picture, whatever was drawn there: what follows is drawn as into
  /// a picture of that extent.
  void begin(VkCommandBuffer commands, const VkRect2D& area, Background background) const;
  /// The surface; its back, where it is drawn, is darker. Commands recorded before must have made
  /// its buffers visible to the vertex stage (a gpu::Recorder begins with that).
  void draw(VkCommandBuffer commands, VkExtent2D extent, const Surface& surface,
            const SurfacePaint& paint, const Camera& camera, const SurfaceStyle& style) const;
  void draw(VkCommandBuffer commands, VkExtent2D extent, const OverlayBuffer& overlay) const;
  /// A mesh in the style but for its colour, which is SurfaceColor::carried; points as disks of
  /// that colour, a few points wide.
  void draw(VkCommandBuffer commands, VkExtent2D extent, const CarriedDrawing& drawing,
            const Camera& camera, const SurfaceStyle& style) const;

 private:
  /// What the vertex stage is told of what it draws.
  enum class Numbers : std::uint32_t { corners, vertices };

  void fill(VkCommandBuffer commands, const VkRect2D& area, Background background) const;
  const GraphicsPipeline& surface_pipeline(std::uint32_t flags, Numbers numbers) const;

  /// Of surfaces that are looked at in one way.
  struct StylePipeline {
    StylePipeline(const gpu::Context& context, const TargetFormat& target, std::uint32_t its_flags,
                  bool is_fixed, Numbers its_numbers);

    std::uint32_t flags;
    Numbers numbers;
    std::array<std::uint32_t, 4> constants;  ///< shaders/surface.glsl
    GraphicsPipeline pipeline;
  };

  const gpu::Context& context_;
  TargetFormat target_;
  std::uint32_t shaders_encode_;  ///< constant 0 of all pipelines; shaders/target.glsl
  Pipelines pipelines_;
  GraphicsPipeline background_;
  mutable std::vector<std::unique_ptr<const StylePipeline>> surfaces_;
  GraphicsPipeline overlay_;
  GraphicsPipeline points_;
  gpu::Buffer color_maps_;
};

}  // namespace lapwing
