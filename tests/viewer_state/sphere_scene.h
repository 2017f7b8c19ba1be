#pragma once

#include "lapwing/mesh/shapes.h"
#include "tools/scene_tool.h"
#include "viewer_state/test_view.h"

namespace lapwing::viewer::test {

/// A unit sphere in front of a window, and a hand that clicks on it.
struct SphereScene {
  AppState state = open_state(icosphere(4));
  Projection view = perspective({0.3, 0.4, 6}, {0, 0, 0});
  Part part;

  ToolScene scene() const {
    const auto& positions = state.rest->positions;
    return {state,
            positions,
            view,
            [this, &positions](const Vector2d& pixel) {
              return pick_surface(state.rest->topology(), positions, view.ray_through(pixel));
            },
            [this, &positions](Index v) {
              return positions[v].dot(view.toward_eye(positions[v])) > 0.0;
            },
            part};
  }
  Vector2d pixel_of(const Vector3d& point) const { return *view.to_pixel(point); }
  Vector2d pixel_of(Index v) const { return pixel_of(state.rest->positions[v]); }
  Index vertex_near(const Vector3d& point) const {
    return pick_surface(state.rest->topology(), state.rest->positions,
                        view.ray_through(pixel_of(point)))
        ->vertex;
  }
  void perform(const ToolAnswer& answer) {
    if (answer.command) state = apply(std::move(state), *answer.command);
  }
  /// Presses on `pixel` with `tool`, and performs the command that the tool returns.
  ToolAnswer press_with(SceneTool& tool, const Vector2d& pixel, const Modifiers& modifiers = {}) {
    InputEvent event = press(pixel);
    event.modifiers = modifiers;
    ToolAnswer answer = tool.handle(event, scene());
    perform(answer);
    return answer;
  }
  const VertexSet& roi() const { return state.selection.roi.vertices; }
};

}  // namespace lapwing::viewer::test
