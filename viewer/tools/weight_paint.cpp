#include "tools/weight_paint.h"

#include "lapwing/region/joined_regions.h"

namespace lapwing::viewer {
namespace {

constexpr Part kPainted{Part::Role::roi};

}  // namespace

WeightPaint::WeightPaint() {
  paint_.options().shape = PaintTool::Shape::brush;
}

ToolAnswer WeightPaint::handle(const InputEvent& event, const ToolScene& scene) {
  field_.resize(scene.state.rest->vertex_count(), 0.0);
  // An empty or a full selection, so that the brush can add or remove every vertex.
  AppState canvas;
  canvas.rest = scene.state.rest;
  canvas.joined = scene.state.joined;
  canvas.parameters.seams = scene.state.parameters.seams;
  const bool erases = is_dragging() ? paint_.erases() : brush().erase != event.modifiers.control;
  if (erases) canvas.selection.roi = choose({AllVertices{}}, *canvas.rest);
  ToolAnswer answer = paint_.handle(
      event, {canvas, scene.positions, scene.projection, scene.pick, scene.is_visible, kPainted});
  if (answer.command) {
    if (const auto* painted = std::get_if<Paint>(&*answer.command)) {
      const JoinedSurface* joined = joined_seams(canvas);
      const auto set = [&](const VertexSet& vertices, double weight) {
        for (const Index v : joined ? with_followers(vertices, *joined) : vertices) {
          field_[v] = weight;
        }
      };
      set(painted->added, strength);
      set(painted->removed, 0.0);
    }
    // A stroke changes the field, not the selection.
    answer.command.reset();
  }
  return answer;
}

std::vector<double> WeightPaint::live_field() const {
  std::vector<double> field = field_;
  if (!is_dragging()) return field;
  for (const Index v : paint_.live()) {
    if (v < field.size()) field[v] = paint_.erases() ? 0.0 : strength;
  }
  return field;
}

void WeightPaint::soften(const Topology& topology) {
  const std::vector<double> before = field_;
  for (Index v = 0; v < before.size(); ++v) {
    double sum = before[v];
    for (const Index n : topology.rings[v]) sum += before[n];
    field_[v] = sum / static_cast<double>(topology.rings.size(v) + 1);
  }
}

}  // namespace lapwing::viewer
