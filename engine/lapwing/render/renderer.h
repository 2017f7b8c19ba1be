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
  plain,    ///< a light clay
  regions,  ///< by class: outside grey, ROI bluish, belt red, handle yellow
  scalar,   ///< by number, through the colour map
  carried,  ///< the colour of carried drawings
};

/// How a surface looks.
struct SurfaceStyle {
  SurfaceColor color = SurfaceColor::plain;
  ColorMap color_map = ColorMap::sequential;
  std::optional<ScalarRange> range;  ///< range of the colour map; by default that of the numbers
  /// Shows the colours of the mesh's file, if the paint has them, instead of the clay and, with
  /// regions, instead of the grey outside.
  bool file_colors = false;
  bool wireframe = false;  ///< polygon edges over the surface
  bool flat = false;       ///< one normal per triangle
  /// Pixel density of the display. Wireframe edges, carried points and the reach of relief
  /// darkening grow with it in pixels, so that they look the same at any density.
  float pixels_per_point = 1.0F;
  /// `front` is faster and gives the same picture if no back is visible (see is_closed_outward).
  Sides sides = Sides::both;

  bool operator==(const SurfaceStyle&) const = default;
};

/// A mesh or points that are carried along with a surface and drawn in the same picture.
struct CarriedDrawing {
  Surface* surface = nullptr;           ///< null for points
  const SurfacePaint* paint = nullptr;  ///< paint of the surface
  const PointCloud* points = nullptr;   ///< null for a mesh
};

/// Returns the range of the colour map of `style`. By default it is that of the paint's numbers,
/// made symmetric around 0 for a diverging map.
ScalarRange color_range(const SurfaceStyle& style, const SurfacePaint& paint);

/// Returns the matrix from positions relative to `origin` to Vulkan's clip space in a picture of
/// `extent` pixels. In float64, so that a mesh far from the world's origin keeps its digits.
Eigen::Matrix4d clip_from_surface(const Camera& camera, VkExtent2D extent,
                                  const Eigen::Vector3d& origin);

/// Records draws into a rendering scope (vkCmdBeginRendering) that the caller began, on images of a
/// window or an OffscreenTarget. Draws from the buffers of the surface, without copies or uploads.
/// What is drawn must live until the commands have run; on a software device the surface must not
/// move until then. The context must outlive the renderer.
class Renderer {
 public:
  /// How the pipelines of surfaces are created: a specialized one for each style when it is first
  /// drawn, or one for all styles, for comparison.
  enum class Pipelines { by_style, one };

  /// Throws GpuError if the context's queue has no graphics.
  Renderer(gpu::Context& context, const TargetFormat& target,
           Pipelines pipelines = Pipelines::by_style);

  /// Sets viewport and scissor and fills the picture. Must come first in every scope.
  void begin(VkCommandBuffer commands, VkExtent2D extent, Background background) const;
  /// Clears a part of the picture. What follows is drawn there, as into a picture of that extent.
  void begin(VkCommandBuffer commands, const VkRect2D& area, Background background) const;
  /// Draws the surface, its backs darker. Commands recorded before must have made its buffers
  /// visible to the vertex stage, as the start of a gpu::Recorder does.
  void draw(VkCommandBuffer commands, VkExtent2D extent, const Surface& surface,
            const SurfacePaint& paint, const Camera& camera, const SurfaceStyle& style) const;
  void draw(VkCommandBuffer commands, VkExtent2D extent, const OverlayBuffer& overlay) const;
  /// Draws a mesh in the style, but with SurfaceColor::carried, or points as disks of that colour,
  /// a few points wide.
  void draw(VkCommandBuffer commands, VkExtent2D extent, const CarriedDrawing& drawing,
            const Camera& camera, const SurfaceStyle& style) const;

 private:
  /// What the vertex index counts in the vertex stage.
  enum class Numbers : std::uint32_t { corners, vertices };

  void fill(VkCommandBuffer commands, const VkRect2D& area, Background background) const;
  const GraphicsPipeline& surface_pipeline(std::uint32_t flags, Numbers numbers) const;

  /// The pipeline of surfaces in one style.
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
