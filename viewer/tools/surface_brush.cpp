#include "tools/surface_brush.h"

#include <variant>

#include "lapwing/region/joined_regions.h"

namespace lapwing::viewer {

SurfaceBrush::Answer SurfaceBrush::handle(const InputEvent& event, const ToolScene& scene) {
  // An empty or a full selection, so that the brush can add or remove every vertex.
  AppState canvas;
  canvas.rest = scene.state.rest;
  canvas.joined = scene.state.joined;
  canvas.parameters.seams = scene.state.parameters.seams;
  const bool erases =
      tool_.is_dragging() ? tool_.erases() : options().erase != event.modifiers.control;
  if (erases) canvas.selection.roi = choose({AllVertices{}}, *canvas.rest);
  Answer answer{tool_.handle(event, {canvas, scene.positions, scene.projection, scene.pick,
                                     scene.is_visible, Part{Part::Role::roi}}),
                {}};
  if (!answer.answer.command) return answer;
  const auto& painted = std::get<Paint>(*answer.answer.command);
  VertexSet vertices = erases ? painted.removed : painted.added;
  const JoinedSurface* joined = joined_seams(canvas);
  if (joined != nullptr) vertices = with_followers(vertices, *joined);
  answer.stroke = Stroke{std::move(vertices), erases};
  answer.answer.command.reset();
  return answer;
}

}  // namespace lapwing::viewer
