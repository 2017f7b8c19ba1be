#include "tools/grab_tool.h"

#include <algorithm>
#include <utility>

#include "lapwing/region/grab_region.h"

namespace lapwing::viewer {
namespace {

// The inner part of the circle, which the handle holds with full weight.
constexpr double kFullPart = 0.5;

// A smaller circle grabs a few vertices nevertheless.
constexpr double kLeastEdges = 2.0;

double mean_edge_at(Index vertex, const ToolScene& scene) {
  const auto ring = surface_of(scene.state)->topology().rings[vertex];
  double sum = 0.0;
  for (const Index w : ring) sum += (scene.positions[w] - scene.positions[vertex]).norm();
  return sum / static_cast<double>(ring.size());
}

std::optional<std::size_t> handle_at(Index vertex, const EditSelection& selection) {
  for (std::size_t h = 0; h < selection.handles.size(); ++h) {
    if (std::ranges::binary_search(selection.handles[h].vertices, vertex)) return h;
  }
  return std::nullopt;
}

Grab grab_at(const SurfacePoint& pick, double radius, double factor, const ToolScene& scene) {
  const double brush = std::max(radius, kLeastEdges * mean_edge_at(pick.vertex, scene));
  GrabRegion region =
      grab_region(surface_of(scene.state)->topology(), scene.positions, pick.vertex, brush, factor);
  Grab grab;
  grab.roi.vertices = std::move(region.vertices);
  grab.roi.made = {GeodesicDisk{pick.vertex, region.radius}, "ROI"};
  if (!region.cut_off.empty()) {
    RegionSpec cut_off{ListedVertices{std::move(region.cut_off)}, "ROI"};
    grab.roi.made = {UnionRegion{{std::move(grab.roi.made), std::move(cut_off)}}, "ROI"};
  }
  grab.handle = {GeodesicDisk{pick.vertex, kFullPart * brush}, "handle"};
  grab.falloff.transition = Transition{.width = (1.0 - kFullPart) * brush};
  return grab;
}

}  // namespace

ToolAnswer GrabTool::handle(const InputEvent& event, const ToolScene& scene) {
  if (const double steps = size_steps(event); steps != 0.0) {
    radius_pt_ = resized_brush_pt(radius_pt_, steps);
    return ToolAnswer::only_taken();
  }
  if (event.kind != InputKind::press || event.button != MouseButton::left) {
    return ToolAnswer::passed_on();
  }
  const auto pick = scene.pick(event.position);
  if (!pick) return ToolAnswer::passed_on();
  ToolAnswer answer = ToolAnswer::only_taken();
  answer.drags_held = true;
  const bool resizes = event.modifiers.shift || event.modifiers.control;
  if (!resizes) answer.holds = handle_at(pick->vertex, scene.state.selection);
  if (answer.holds) return answer;
  const double radius =
      scene.projection.in_pixels(radius_pt_) * scene.projection.length_of_pixel(pick->position);
  const double factor = event.modifiers.shift ? 0.5 : event.modifiers.control ? 2.0 : 1.0;
  answer.command = grab_at(*pick, radius, factor, scene);
  answer.holds = 0;
  return answer;
}

const char* GrabTool::hint(const AppState&, const Part&) const {
  return "Drag the surface. Shift: smaller area, Ctrl: larger area.";
}

}  // namespace lapwing::viewer
