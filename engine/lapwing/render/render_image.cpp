#include "lapwing/render/render_image.h"

#include "lapwing/render/surface.h"

namespace lapwing {

ImageRenderer::ImageRenderer(gpu::Context& context, const RenderOptions& options)
    : context_(context),
      options_(options),
      target_(context, options.width, options.height, options.samples),
      renderer_(context, target_.format()) {}

Image ImageRenderer::render(Surface& surface, const SurfacePaint& paint, const Camera& camera,
                            std::span<const CarriedDrawing> carried) {
  surface.finish();
  for (const CarriedDrawing& drawing : carried) {
    if (drawing.surface != nullptr) drawing.surface->finish();
  }
  std::optional<OverlayBuffer> legend;
  if (options_.legend && options_.style.color == SurfaceColor::scalar) {
    const ScalarRange shown = color_range(options_.style, paint);
    const ScalarRange& numbers = paint.scalar_range();
    legend.emplace(context_, legend_overlay({options_.style.color_map, shown, options_.legend_title,
                                             numbers.high > shown.high, numbers.low < shown.low},
                                            options_.width, options_.height));
  }
  Image image = target_.render([&](VkCommandBuffer commands) {
    renderer_.begin(commands, target_.extent(), options_.background);
    renderer_.draw(commands, target_.extent(), surface, paint, camera, options_.style);
    for (const CarriedDrawing& drawing : carried) {
      renderer_.draw(commands, target_.extent(), drawing, camera, options_.style);
    }
    if (options_.grid) {
      renderer_.draw(commands, target_.extent(), *options_.grid, camera,
                     options_.style.pixels_per_point);
    }
    if (legend) renderer_.draw(commands, target_.extent(), *legend);
  });
  if (options_.background == Background::transparent) unpremultiply(image);
  return image;
}

Image render_image(Surface& surface, const SurfacePaint& paint, const Camera& camera,
                   const RenderOptions& options, std::span<const CarriedDrawing> carried) {
  return ImageRenderer(surface.context(), options).render(surface, paint, camera, carried);
}

}  // namespace lapwing
