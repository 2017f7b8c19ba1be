#include "lapwing/render/renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "lapwing/base/errors.h"
#include "lapwing/gpu/context.h"
#include "lapwing/gpu/transfer.h"
#include "lapwing/render/point_cloud.h"
#include "lapwing/render/surface.h"
#include "lapwing/shaders/background_frag.h"
#include "lapwing/shaders/background_vert.h"
#include "lapwing/shaders/ground_grid_frag.h"
#include "lapwing/shaders/ground_grid_vert.h"
#include "lapwing/shaders/overlay_frag.h"
#include "lapwing/shaders/overlay_vert.h"
#include "lapwing/shaders/points_frag.h"
#include "lapwing/shaders/points_vert.h"
#include "lapwing/shaders/surface_frag.h"
#include "lapwing/shaders/surface_vert.h"

namespace lapwing {
namespace {

// Push constants of the shaders background, surface, overlay, points and ground_grid, in std430
// layout.
struct BackgroundPush {
  std::array<float, 4> top;  // sRGB and opacity
  std::array<float, 4> bottom;
};

struct SurfacePush {
  std::array<float, 16> clip_from_surface;  // columns
  std::array<float, 12> view_from_surface;  // rows
  std::uint32_t flags;
  float scalar_low;
  float scalar_scale;
  float pixels_per_point;
};
static_assert(sizeof(SurfacePush) == 128, "what every device offers");

struct OverlayPush {
  std::array<float, 2> clip_per_pixel;
};

struct PointsPush {
  std::array<float, 16> clip_from_points;  // columns
  std::array<float, 2> clip_radius;
};

struct GroundGridPush {
  std::array<float, 16> clip_from_cells;  // columns
  std::array<float, 4> second_axis_color;
  std::array<float, 2> origin;
  float radius;
  float line_width;
};

constexpr float kCarriedRadiusPt = 3.5F;

// Bits of SurfacePush::flags; shaders/surface.glsl.
enum SurfaceFlag : std::uint32_t {
  kRegions = 1,
  kScalar = 2,
  kWireframe = 4,
  kFlat = 8,
  kDiverging = 16,
  kOrthographic = 32,
  kCarriedColor = 64,
  kFileColor = 128,
  kXray = 256,
  kClayMatcap = 512,
  kMetalMatcap = 1024,
  kPearlMatcap = 2048,
};

constexpr std::size_t kColorMapEntries = 256;  // per map; shaders/surface.frag

std::uint32_t flags_of(const SurfaceStyle& style, const SurfacePaint& paint, const Camera& camera) {
  std::uint32_t flags = 0;
  const bool has_own = style.color == SurfaceColor::plain || style.color == SurfaceColor::regions;
  if (has_own && style.file_colors && paint.has_file_colors()) flags |= kFileColor;
  if (style.color == SurfaceColor::regions) flags |= kRegions;
  if (style.color == SurfaceColor::scalar) flags |= kScalar;
  if (style.color == SurfaceColor::carried) flags |= kCarriedColor;
  if (style.wireframe || style.xray) flags |= kWireframe;
  if (style.xray) flags |= kXray;
  if (style.flat) flags |= kFlat;
  if (style.matcap == Matcap::clay) flags |= kClayMatcap;
  if (style.matcap == Matcap::metal) flags |= kMetalMatcap;
  if (style.matcap == Matcap::pearl) flags |= kPearlMatcap;
  if (style.color_map == ColorMap::diverging) flags |= kDiverging;
  if (camera.orthographic) flags |= kOrthographic;
  return flags;
}

gpu::Buffer make_color_maps(gpu::Context& context) {
  std::vector<std::array<float, 4>> entries;
  for (const ColorMap map : {ColorMap::sequential, ColorMap::diverging}) {
    for (std::size_t e = 0; e < kColorMapEntries; ++e) {
      const Eigen::Vector3f color =
          map_color(map, static_cast<float>(e) / static_cast<float>(kColorMapEntries - 1));
      entries.push_back({color.x(), color.y(), color.z(), 1.0F});
    }
  }
  gpu::Buffer buffer(context, "colour maps", entries.size() * sizeof entries[0]);
  gpu::Transfer(context).upload(buffer, entries);
  return buffer;
}

BackgroundPush background_push(Background background) {
  switch (background) {
    case Background::gradient:
      return {{0.960F, 0.967F, 0.975F, 1.0F}, {0.800F, 0.818F, 0.840F, 1.0F}};
    case Background::white:
      return {{1.0F, 1.0F, 1.0F, 1.0F}, {1.0F, 1.0F, 1.0F, 1.0F}};
    case Background::transparent:
      break;
  }
  return {};
}

Eigen::Matrix4d view_from_surface(const Camera& camera, const Eigen::Vector3d& origin) {
  Eigen::Matrix4d view = camera.view();
  view.topRightCorner<3, 1>() += view.topLeftCorner<3, 3>() * origin;
  return view;
}

SurfacePush surface_push(VkExtent2D extent, const Eigen::Vector3d& origin, const Camera& camera,
                         const SurfaceStyle& style, const SurfacePaint& paint) {
  SurfacePush push{};
  Eigen::Map<Eigen::Matrix4f>(push.clip_from_surface.data()) =
      clip_from_surface(camera, extent, origin).cast<float>();
  Eigen::Map<Eigen::Matrix<float, 3, 4, Eigen::RowMajor>>(push.view_from_surface.data()) =
      view_from_surface(camera, origin).topRows<3>().cast<float>();
  const ScalarRange range = color_range(style, paint);
  push.flags = flags_of(style, paint, camera);
  push.scalar_low = range.low;
  push.scalar_scale = range.high > range.low ? 1.0F / (range.high - range.low) : 0.0F;
  push.pixels_per_point = style.pixels_per_point;
  return push;
}

}  // namespace

Eigen::Matrix4d clip_from_surface(const Camera& camera, VkExtent2D extent,
                                  const Eigen::Vector3d& origin) {
  const double aspect = static_cast<double>(extent.width) / static_cast<double>(extent.height);
  return camera.projection(aspect) * view_from_surface(camera, origin);
}

Matcap matcap_named(std::string_view name) {
  if (name == "none") return Matcap::none;
  if (name == "clay") return Matcap::clay;
  if (name == "metal") return Matcap::metal;
  if (name == "pearl") return Matcap::pearl;
  throw InputError("unknown matcap \"" + std::string(name) +
                   "\"; choose one of none, clay, metal, pearl");
}

ScalarRange color_range(const SurfaceStyle& style, const SurfacePaint& paint) {
  if (style.range) return *style.range;
  const ScalarRange range = paint.scalar_range();
  if (style.color_map == ColorMap::sequential) return range;
  const float largest = std::max(std::abs(range.low), std::abs(range.high));
  return {-largest, largest};
}

Renderer::StylePipeline::StylePipeline(const gpu::Context& context, const TargetFormat& target,
                                       std::uint32_t its_flags, bool is_fixed, Numbers its_numbers)
    : flags(its_flags),
      numbers(its_numbers),
      constants{target.shaders_encode ? 1U : 0U, its_flags, is_fixed ? 1U : 0U,
                its_numbers == Numbers::vertices ? 1U : 0U},
      pipeline(context, target,
               {.name = "a surface",
                .vertex_spirv = shaders::surface_vert(),
                .fragment_spirv = shaders::surface_frag(),
                .storage_buffers = 11,
                .push_constant_bytes = sizeof(SurfacePush),
                .constants = constants,
                .depth = (its_flags & kXray) == 0,
                .blend = (its_flags & kXray) != 0}) {}

Renderer::Renderer(gpu::Context& context, const TargetFormat& target, Pipelines pipelines)
    : context_(context),
      target_(target),
      shaders_encode_(target.shaders_encode ? 1U : 0U),
      pipelines_(pipelines),
      background_(context, target,
                  {.name = "the background",
                   .vertex_spirv = shaders::background_vert(),
                   .fragment_spirv = shaders::background_frag(),
                   .push_constant_bytes = sizeof(BackgroundPush),
                   .constants = std::span(&shaders_encode_, 1)}),
      overlay_(context, target,
               {.name = "an overlay",
                .vertex_spirv = shaders::overlay_vert(),
                .fragment_spirv = shaders::overlay_frag(),
                .storage_buffers = 1,
                .push_constant_bytes = sizeof(OverlayPush),
                .constants = std::span(&shaders_encode_, 1)}),
      points_(context, target,
              {.name = "points",
               .vertex_spirv = shaders::points_vert(),
               .fragment_spirv = shaders::points_frag(),
               .storage_buffers = 1,
               .push_constant_bytes = sizeof(PointsPush),
               .constants = std::span(&shaders_encode_, 1),
               .depth = true}),
      ground_grid_(context, target,
                   {.name = "the ground grid",
                    .vertex_spirv = shaders::ground_grid_vert(),
                    .fragment_spirv = shaders::ground_grid_frag(),
                    .push_constant_bytes = sizeof(GroundGridPush),
                    .constants = std::span(&shaders_encode_, 1),
                    .depth = true,
                    .blend = true}),
      color_maps_(make_color_maps(context)) {}

void Renderer::begin(VkCommandBuffer commands, VkExtent2D extent, Background background) const {
  fill(commands, {{0, 0}, extent}, background);
}

void Renderer::begin(VkCommandBuffer commands, const VkRect2D& area, Background background) const {
  // Depth is reversed: the farthest depth is 0, which is the default clear value.
  VkClearAttachment depth{};
  depth.aspectMask = VK_IMAGE_ASPECT_DEPTH_BIT;
  const VkClearRect cleared{area, 0, 1};
  context_.vk().vkCmdClearAttachments(commands, 1, &depth, 1, &cleared);
  fill(commands, area, background);
}

void Renderer::fill(VkCommandBuffer commands, const VkRect2D& area, Background background) const {
  set_viewport(context_, commands, area);
  background_.draw(commands, {}, background_push(background), 3);
}

void Renderer::draw(VkCommandBuffer commands, VkExtent2D extent, const Surface& surface,
                    const SurfacePaint& paint, const Camera& camera,
                    const SurfaceStyle& style) const {
  if (surface.triangle_count() == 0) return;
  const SurfacePush push = surface_push(extent, surface.origin(), camera, style, paint);
  const auto draw = [&](Sides sides, Numbers numbers, const auto&... what) {
    surface_pipeline(push.flags, numbers)
        .draw(commands,
              {surface.position_buffer(), surface.normal_buffer(), surface.triangle_buffer(),
               paint.class_buffer(), paint.scalar_buffer(), paint.edge_buffer(), color_maps_,
               paint.corner_source_buffer(), paint.corner_place_buffer(), paint.image_buffer(),
               surface.corner_normal_buffer()},
              push, what..., sides);
  };
  const bool needs_corners = (push.flags & (kWireframe | kFlat | kFileColor)) != 0;
  const bool by_vertex = !needs_corners && pipelines_ == Pipelines::by_style;
  const DrawOrder* order = by_vertex ? surface.draw_order() : nullptr;
  if (order == nullptr) {
    const auto corners = static_cast<std::uint32_t>(3 * surface.triangle_count());
    if (!style.xray) return draw(style.sides, Numbers::corners, corners, 0U);
    draw(Sides::back, Numbers::corners, corners, 0U);
    draw(Sides::front, Numbers::corners, corners, 0U);
    return;
  }
  const auto smooth = static_cast<std::uint32_t>(3 * order->smooth_count());
  const auto sharp = static_cast<std::uint32_t>(3 * order->sharp_count());
  const auto draw_sides = [&](Sides sides) {
    const gpu::Buffer* indices = &order->index_buffer();
    if (smooth > 0) draw(sides, Numbers::vertices, IndexRange{indices, 0, smooth});
    if (sharp > 0) draw(sides, Numbers::corners, IndexRange{indices, smooth, sharp});
  };
  if (style.sides != Sides::both) return draw_sides(style.sides);
  // Draw the front faces first: the depth test then discards most back faces without shading.
  draw_sides(Sides::front);
  draw_sides(Sides::back);
}

const GraphicsPipeline& Renderer::surface_pipeline(std::uint32_t flags, Numbers numbers) const {
  const bool is_fixed = pipelines_ == Pipelines::by_style;
  if (!is_fixed) flags &= kXray;  // the only flag that changes the state of the pipeline
  for (const auto& made : surfaces_) {
    if (made->flags == flags && made->numbers == numbers) return made->pipeline;
  }
  surfaces_.push_back(std::make_unique<StylePipeline>(context_, target_, flags, is_fixed, numbers));
  return surfaces_.back()->pipeline;
}

void Renderer::draw(VkCommandBuffer commands, VkExtent2D extent,
                    const OverlayBuffer& overlay) const {
  if (overlay.rectangle_count() == 0) return;
  const OverlayPush push{
      {2.0F / static_cast<float>(extent.width), 2.0F / static_cast<float>(extent.height)}};
  overlay_.draw(commands, {overlay.buffer()}, push, 6 * overlay.rectangle_count());
}

void Renderer::draw(VkCommandBuffer commands, VkExtent2D extent, const CarriedDrawing& drawing,
                    const Camera& camera, const SurfaceStyle& style) const {
  if (drawing.surface != nullptr) {
    SurfaceStyle carried = style;
    carried.color = SurfaceColor::carried;
    carried.sides = Sides::both;
    return draw(commands, extent, *drawing.surface, *drawing.paint, camera, carried);
  }
  const PointCloud& points = *drawing.points;
  PointsPush push{};
  Eigen::Map<Eigen::Matrix4f>(push.clip_from_points.data()) =
      clip_from_surface(camera, extent, points.origin()).cast<float>();
  const float radius = style.pixels_per_point * kCarriedRadiusPt;
  push.clip_radius = {2.0F * radius / static_cast<float>(extent.width),
                      2.0F * radius / static_cast<float>(extent.height)};
  points_.draw(commands, {points.buffer()}, push, static_cast<std::uint32_t>(6 * points.size()));
}

void Renderer::draw(VkCommandBuffer commands, VkExtent2D extent, const GroundGrid& grid,
                    const Camera& camera, float pixels_per_point) const {
  const bool y_up = grid.up == UpAxis::y;
  const Eigen::Index second = y_up ? 2 : 1;
  const Eigen::Matrix4d clip = clip_from_surface(camera, extent, grid.center);
  Eigen::Matrix4d clip_from_cells = Eigen::Matrix4d::Zero();
  clip_from_cells.col(0) = grid.spacing * clip.col(0);
  clip_from_cells.col(1) = grid.spacing * clip.col(second);
  clip_from_cells.col(3) = clip.col(3);
  GroundGridPush push{};
  Eigen::Map<Eigen::Matrix4f>(push.clip_from_cells.data()) = clip_from_cells.cast<float>();
  push.second_axis_color = y_up ? std::array{0.30F, 0.50F, 0.90F, 1.0F}   // z, blue
                                : std::array{0.35F, 0.70F, 0.25F, 1.0F};  // y, green
  push.origin = {static_cast<float>(-grid.center.x() / grid.spacing),
                 static_cast<float>(-grid.center[second] / grid.spacing)};
  push.radius = static_cast<float>(grid.radius / grid.spacing);
  push.line_width = pixels_per_point;
  ground_grid_.draw(commands, {}, push, 6);
}

}  // namespace lapwing
