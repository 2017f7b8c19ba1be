#include "tools/pin_tool.h"

namespace lapwing::viewer {
namespace {

// Radius of a pin's dot, and a margin for the hand.
constexpr double kPinReachPt = 9.0;

}  // namespace

bool is_pin(const ChosenRegion& handle) {
  return handle.vertices.size() == 1;
}

std::optional<std::size_t> pin_at(const Eigen::Vector2d& pixel, const ToolScene& scene) {
  std::optional<std::size_t> nearest;
  double distance = scene.projection.in_pixels(kPinReachPt);
  const auto& handles = scene.state.selection.handles;
  for (std::size_t h = 0; h < handles.size(); ++h) {
    if (!is_pin(handles[h])) continue;
    const Eigen::Vector3d& pin = scene.positions[handles[h].vertices.front()];
    const auto place = scene.projection.to_pixel(pin);
    if (!place || !((*place - pixel).norm() < distance)) continue;
    if (is_hidden(pin, *place, scene)) continue;
    distance = (*place - pixel).norm();
    nearest = h;
  }
  return nearest;
}

ToolAnswer PinTool::handle(const InputEvent& event, const ToolScene& scene) {
  if (event.kind != InputKind::press || event.button != MouseButton::left) {
    return ToolAnswer::passed_on();
  }
  ToolAnswer answer = ToolAnswer::only_taken();
  answer.drags_held = !event.modifiers.shift;
  answer.holds = pin_at(event.position, scene);
  if (answer.holds) return answer;
  const auto pick = scene.pick(event.position);
  if (!pick) return ToolAnswer::passed_on();
  const std::size_t next = scene.state.selection.handles.size();
  answer.holds = next;
  answer.command = Choose{{Part::Role::handle, next}, {ListedVertices{{pick->vertex}}, "pin"}};
  return answer;
}

const char* PinTool::hint(const AppState& state, const Part&) const {
  return state.selection.handles.empty() ? "Press on a vertex to pin it, then drag."
                                         : "Drag a pin, or press on another vertex to pin it.";
}

}  // namespace lapwing::viewer
