#include "tools/paint_tool.h"

#include <algorithm>
#include <cmath>

#include "tools/screen_geometry.h"
#include "tools/selection_edits.h"

namespace lapwing::viewer {

using Eigen::Vector2d;

ToolAnswer PaintTool::handle(const InputEvent& event, const ToolScene& scene) {
  if (const double steps = size_steps(event); steps != 0.0) {
    options_.radius_pt = resized_brush_pt(options_.radius_pt, steps);
    return ToolAnswer::only_taken();
  }
  if (!dragging_) {
    control_ = event.modifiers.control;
    if (event.kind != InputKind::press || event.button != MouseButton::left) {
      return ToolAnswer::passed_on();
    }
    begin(event, scene);
    return ToolAnswer::only_taken();
  }
  switch (event.kind) {
    case InputKind::key:
      if (event.key != kEscape) return ToolAnswer::passed_on();
      give_up();
      return ToolAnswer::only_taken();
    case InputKind::scroll:
      // The stroke is in pixels of this view, so the view must not zoom.
      return ToolAnswer::only_taken();
    case InputKind::move:
      extend(event.position, scene);
      return ToolAnswer::only_taken();
    case InputKind::release:
      if (event.button != MouseButton::left) return ToolAnswer::passed_on();
      extend(event.position, scene);
      return finish(scene);
    default:
      return ToolAnswer::passed_on();
  }
}

void PaintTool::begin(const InputEvent& event, const ToolScene& scene) {
  dragging_ = true;
  pixels_ = vertex_pixels(scene.positions, scene.projection);
  way_ = {event.position};
  touched_.clear();
  extend(event.position, scene);
}

void PaintTool::extend(const Vector2d& to, const ToolScene& scene) {
  switch (options_.shape) {
    case Shape::brush:
      touched_ = unite(touched_, seen(near_line(pixels_, way_.back(), to,
                                                scene.projection.in_pixels(options_.radius_pt)),
                                      scene));
      way_ = {to};
      break;
    case Shape::lasso:
      way_.push_back(to);
      touched_ = seen(in_polygon(pixels_, way_), scene);
      break;
    case Shape::box:
      way_ = {way_.front(), to};
      touched_ = seen(in_rectangle(pixels_, way_.front(), to), scene);
  }
}

VertexSet PaintTool::seen(VertexSet vertices, const ToolScene& scene) const {
  if (!options_.through && scene.is_visible) {
    std::erase_if(vertices, [&](Index v) { return !scene.is_visible(v); });
  }
  return vertices;
}

ToolAnswer PaintTool::finish(const ToolScene& scene) {
  auto command = paint(scene.state, scene.part, touched_, erases());
  give_up();
  return {.taken = true, .command = std::move(command)};
}

void PaintTool::give_up() {
  dragging_ = false;
  way_.clear();
  touched_.clear();
}

const char* PaintTool::hint(const AppState& state, const Part& part) const {
  if (!vertices_of(state.selection, part).empty()) {
    return of_part(part, "Paint more of the region. Ctrl erases, Enter continues with the handle.",
                   "Paint more of the fixed border. Ctrl erases.",
                   "Paint more of the handle. Ctrl erases, Enter continues with moving it.");
  }
  return of_part(part, "Paint the region to edit.", "Paint the fixed border.",
                 "Paint a handle inside the region.");
}

std::size_t PaintTool::count_with(const VertexSet& chosen) const {
  if (!dragging_) return chosen.size();
  return (erases() ? subtract(chosen, touched_) : unite(chosen, touched_)).size();
}

ToolMarks PaintTool::marks() const {
  return {.outline = outline(),
          .brush_pt = options_.shape == Shape::brush ? options_.radius_pt : 0.0};
}

std::vector<Vector2d> PaintTool::outline() const {
  if (options_.shape == Shape::lasso) return way_;
  if (options_.shape != Shape::box || way_.size() < 2) return {};
  const Vector2d& a = way_.front();
  const Vector2d& b = way_.back();
  return {a, {b.x(), a.y()}, b, {a.x(), b.y()}};
}

}  // namespace lapwing::viewer
