#include "tools/weight_paint.h"

namespace lapwing::viewer {

ToolAnswer WeightPaint::handle(const InputEvent& event, const ToolScene& scene) {
  field_.resize(scene.state.rest->vertex_count(), 0.0);
  const auto [answer, stroke] = brush_.handle(event, scene);
  if (stroke) {
    for (const Index v : stroke->vertices) field_[v] = stroke->erases ? 0.0 : strength;
  }
  return answer;
}

std::vector<double> WeightPaint::live_field() const {
  std::vector<double> field = field_;
  if (!is_dragging()) return field;
  for (const Index v : brush_.tool().live()) {
    if (v < field.size()) field[v] = brush_.tool().erases() ? 0.0 : strength;
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
