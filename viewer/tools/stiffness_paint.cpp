#include "tools/stiffness_paint.h"

namespace lapwing::viewer {

ToolAnswer StiffnessPaint::handle(const InputEvent& event, const ToolScene& scene) {
  auto [answer, stroke] = brush_.handle(event, scene);
  if (stroke) {
    answer.command =
        SetStiffness{painted_stiffness(scene.state.selection.stiffness, std::move(stroke->vertices),
                                       stroke->erases ? 1.0 : painted_factor())};
  }
  return answer;
}

std::vector<StiffnessSpec> StiffnessPaint::live_stiffness(const AppState& state) const {
  if (!is_dragging()) return state.selection.stiffness;
  return painted_stiffness(state.selection.stiffness, brush_.tool().live(),
                           brush_.tool().erases() ? 1.0 : painted_factor());
}

}  // namespace lapwing::viewer
