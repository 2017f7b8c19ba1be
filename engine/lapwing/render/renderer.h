#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include <volk.h>

#include "lapwing/gpu/buffer.h"
#include "lapwing/render/camera.h"
#include "lapwing/render/color_map.h"
#include "lapwing/render/graphics_pipeline.h"
#include "lapwing/render/ground_grid.h"
#include "lapwing/render/overlay.h"
#include "lapwing/render/surface_paint.h"

namespace lapwing {

class PointCloud;
class Surface;

enum class Background { gradient, white, transparent };

enum class SurfaceColor {
  plain,    ///< a light clay
  regions,  ///< by vertex class: outside grey, ROI bluish, belt red, handle yellow
  scalar,   ///< by scalar value, through the colour map
  carried,  ///< the colour of carried drawings
};

/// A material whose shading depends only on the direction of the normal relative to the view. It
/// replaces the default shading with lights.
enum class Matcap { none, clay, metal, pearl };

/// Returns the matcap called `name`: "none", "clay", "metal" or "pearl". If there is none, throws
/// InputError with all valid names.
Matcap matcap_named(std::string_view name);

struct SurfaceStyle {
  SurfaceColor color = SurfaceColor::plain;
  ColorMap color_map = ColorMap::sequential;
  /// Range of the colour map; by default the range of the values.
  std::optional<ScalarRange> range;
  /// If the paint has colours of the mesh's file, shows them instead of the plain colour or the
  /// grey of SurfaceColor::regions.
  bool file_colors = false;
  bool wireframe = false;  ///< polygon edges over the surface
  bool xray = false;       ///< a transparent surface with its polygon edges
  bool flat = false;       ///< one normal per triangle
  Matcap matcap = Matcap::none;
  /// Pixel density of the display. The sizes of wireframe edges, carried points and relief shading
  /// are multiplied by it, so that they look the same at any density.
  float pixels_per_point = 1.0F;
  /// `front` is faster and gives the same image if no back face is visible (see is_closed_outward).
  Sides sides = Sides::both;

  bool operator==(const SurfaceStyle&) const = default;
};

/// A mesh or points that are carried along with a surface and drawn in the same image.
struct CarriedDrawing {
  Surface* surface = nullptr;           ///< null for points
  const SurfacePaint* paint = nullptr;  ///< paint of the surface
  const PointCloud* points = nullptr;   ///< null for a mesh
};

/// Returns the range of the colour map of `style`. By default, it is the range of the paint's
/// values, extended to be symmetric around 0 for a diverging map.
ScalarRange color_range(const SurfaceStyle& style, const SurfacePaint& paint);

/// Returns the transform from positions relative to `origin` to Vulkan's clip space, for an image
/// of `extent` pixels. Double precision avoids cancellation for a mesh far from the world's origin.
Eigen::Matrix4d clip_from_surface(const Camera& camera, VkExtent2D extent,
                                  const Eigen::Vector3d& origin);

/// Records draw commands into a rendering scope (vkCmdBeginRendering) that the caller has begun,
/// for a window or an OffscreenTarget. Draws from the buffers of the surface, without copies. All
/// drawn objects must exist until the commands have run; on a software device, the surface must not
/// move until then. The context must outlive the renderer.
class Renderer {
 public:
  /// `by_style` creates a specialized pipeline for each style when it is first drawn. `one` uses a
  /// single pipeline for all styles, for comparison.
  enum class Pipelines { by_style, one };

  /// Throws GpuError if the context's queue has no graphics support.
  Renderer(gpu::Context& context, const TargetFormat& target,
           Pipelines pipelines = Pipelines::by_style);

  /// Sets viewport and scissor and draws the background. Must be the first call in every scope.
  void begin(VkCommandBuffer commands, VkExtent2D extent, Background background) const;
  /// Clears `area` of the image. Later draws are restricted to it, as if it were the whole image.
  void begin(VkCommandBuffer commands, const VkRect2D& area, Background background) const;
  /// Draws the surface, with darker back faces. Commands recorded before must have made its buffers
  /// visible to the vertex stage, as the start of a gpu::Recorder does.
  void draw(VkCommandBuffer commands, VkExtent2D extent, const Surface& surface,
            const SurfacePaint& paint, const Camera& camera, const SurfaceStyle& style) const;
  void draw(VkCommandBuffer commands, VkExtent2D extent, const OverlayBuffer& overlay) const;
  /// Draws a mesh in `style` but with SurfaceColor::carried, or points as small disks of that
  /// colour.
  void draw(VkCommandBuffer commands, VkExtent2D extent, const CarriedDrawing& drawing,
            const Camera& camera, const SurfaceStyle& style) const;
  /// Draws the grid with a depth test, so that surfaces drawn before can hide it and it can cover
  /// them.
  void draw(VkCommandBuffer commands, VkExtent2D extent, const GroundGrid& grid,
            const Camera& camera, float pixels_per_point) const;

 private:
  /// Meaning of the vertex index in the vertex shader.
  enum class Numbers : std::uint32_t { corners, vertices };

  void fill(VkCommandBuffer commands, const VkRect2D& area, Background background) const;
  const GraphicsPipeline& surface_pipeline(std::uint32_t flags, Numbers numbers) const;

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
  GraphicsPipeline ground_grid_;
  gpu::Buffer color_maps_;
};

}  // namespace lapwing
