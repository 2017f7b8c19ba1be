#include "tools/stiffness_paint.h"

#include "lapwing/region/joined_regions.h"

namespace lapwing::viewer {

StiffnessPaint::StiffnessPaint() {
  paint_.options().shape = PaintTool::Shape::brush;
}

ToolAnswer StiffnessPaint::handle(const InputEvent& event, const ToolScene& scene) {
  // An empty or a full selection, so that the brush can add or remove every vertex.
  AppState canvas;
  canvas.rest = scene.state.rest;
  canvas.joined = scene.state.joined;
  canvas.parameters.seams = scene.state.parameters.seams;
  const bool erases = is_dragging() ? paint_.erases() : brush().erase != event.modifiers.control;
  if (erases) canvas.selection.roi = choose({AllVertices{}}, *canvas.rest);
  ToolAnswer answer = paint_.handle(
      event, {canvas, scene.positions, scene.projection, scene.pick, scene.is_visible, {}});
  if (!answer.command) return answer;
  const auto& stroke = std::get<Paint>(*answer.command);
  const JoinedSurface* joined = joined_seams(scene.state);
  const VertexSet& touched = erases ? stroke.removed : stroke.added;
  answer.command =
      SetStiffness{painted_stiffness(scene.state.selection.stiffness,
                                     joined != nullptr ? with_followers(touched, *joined) : touched,
                                     erases ? 1.0 : painted_factor())};
  return answer;
}

std::vector<StiffnessSpec> StiffnessPaint::live_stiffness(const AppState& state) const {
  if (!is_dragging()) return state.selection.stiffness;
  return painted_stiffness(state.selection.stiffness, paint_.live(),
                           paint_.erases() ? 1.0 : painted_factor());
}

}  // namespace lapwing::viewer
