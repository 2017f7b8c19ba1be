#include "lapwing/render/render_image.h"

#include <optional>

#include "lapwing/render/offscreen.h"
#include "lapwing/render/surface.h"

namespace lapwing {

Image render_image(Surface& surface, const SurfacePaint& paint, const Camera& camera,
                   const RenderOptions& options, std::span<const CarriedDrawing> carried) {
  surface.finish();
  for (const CarriedDrawing& drawing : carried) {
    if (drawing.surface != nullptr) drawing.surface->finish();
  }
  gpu::Context& context = surface.context();
  OffscreenTarget target(context, options.width, options.height, options.samples);
  const Renderer renderer(context, target.format());
  std::optional<OverlayBuffer> legend;
  if (options.legend && options.style.color == SurfaceColor::scalar) {
    const ScalarRange shown = color_range(options.style, paint);
    const ScalarRange& numbers = paint.scalar_range();
    legend.emplace(context, legend_overlay({options.style.color_map, shown, options.legend_title,
                                            numbers.high > shown.high, numbers.low < shown.low},
                                           options.width, options.height));
  }
  Image image = target.render([&](VkCommandBuffer commands) {
    renderer.begin(commands, target.extent(), options.background);
    renderer.draw(commands, target.extent(), surface, paint, camera, options.style);
    for (const CarriedDrawing& drawing : carried) {
      renderer.draw(commands, target.extent(), drawing, camera, options.style);
    }
    if (legend) renderer.draw(commands, target.extent(), *legend);
  });
  if (options.background == Background::transparent) divide_by_opacity(image);
  return image;
}

}  // namespace lapwing
