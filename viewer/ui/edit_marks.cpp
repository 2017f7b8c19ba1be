#include <array>
#include <imgui.h>

#include "ui/draw_gizmo.h"
#include "ui/panels.h"

namespace lapwing::viewer {
namespace {

using Eigen::Vector2d;

constexpr ImU32 kPointer = IM_COL32(255, 90, 200, 255);
constexpr ImU32 kHole = IM_COL32(90, 190, 255, 255);
constexpr ImU32 kMirror = IM_COL32(90, 190, 255, 28);

void draw_ruler(Pen& pen, const Editor& editor, std::string& readout) {
  const RulerTool& ruler = editor.tool().tools().ruler;
  if (!ruler.has_both_ends() || !editor.view().shown().has_triangles_of_state()) return;
  const auto line = pen.pixels_of(ruler.line());
  if (line.size() < 2) return;
  const std::array<Vector2d, 2> ends{line.front(), line.back()};
  const Vector2d middle = line[line.size() / 2];
  pen.line(line, false, kHighlight, kThickPt);
  pen.line(ends, false, kLine, 1.0);
  for (const Vector2d& end : ends) pen.dot(end, kHighlight);
  ruler.read_out(readout);
  pen.text(middle, {12.0, 12.0}, readout);
}

// Pins are too small to be seen by their colour.
void draw_pins(Pen& pen, const Editor& editor) {
  if (!editor.view().shown().has_triangles_of_state()) return;
  const AppState& state = editor.state();
  const auto& followed = editor.view().shown().followed();
  const auto draw = [&](std::size_t h, const VertexSet& vertices) {
    if (vertices.size() != 1) return;
    const Index v = vertices.front();
    const Eigen::Vector3d place = h < followed.size()
                                      ? Eigen::Vector3d(followed[h] * state.rest->positions[v])
                                      : editor.view().positions()[v];
    const auto pixel = pen.projection().to_pixel(place);
    if (pixel) pen.dot(*pixel, editor.tool().handle() == h ? kHighlight : kLine);
  };
  if (state.mirrored) {
    const std::vector<VertexSet>& handles = state.mirrored->region.handles;
    for (std::size_t h = 0; h < handles.size(); ++h) draw(h, handles[h]);
  } else {
    const std::vector<ChosenHandle>& handles = state.selection.handles;
    for (std::size_t h = 0; h < handles.size(); ++h) draw(h, handles[h].vertices);
  }
}

// Draws the mirror plane, transparent and as large as the mesh.
void draw_mirror(Pen& pen, const Editor& editor) {
  const auto& plane = editor.state().selection.mirror;
  if (!plane) return;
  const Bounds& bounds = editor.view().shown().opened_bounds();
  const Eigen::Vector3d normal = plane->normal.normalized();
  const Eigen::Vector3d center =
      bounds.center() - normal.dot(bounds.center() - plane->point) * normal;
  const Eigen::Vector3d across = 0.5 * bounds.diagonal() * normal.unitOrthogonal();
  const Eigen::Vector3d up = normal.cross(across);
  const std::array<Eigen::Vector3d, 4> corners{center + across + up, center - across + up,
                                               center - across - up, center + across - up};
  const std::span<const Vector2d> pixels = pen.pixels_of(corners);
  if (pixels.size() < corners.size()) return;  // the eye is inside the square
  pen.area(pixels, kMirror);
  pen.line(pixels, true, kHole, 1.0);
}

void draw_marks(Pen& pen, const Editor& editor, const Vector2d& cursor) {
  const ToolMarks marks = editor.tool().scene_tool().marks();
  const ImU32 color = marks.line_is_done ? kHighlight : kLine;
  pen.line(pen.pixels_of(editor, marks.line), false, color, kThickPt);
  for (const Vector2d& dot : pen.pixels_of(editor, marks.dots)) pen.dot(dot, kHighlight);
  for (std::size_t k = 0; k < marks.grips.size(); ++k) {
    // On a surface that is being moved the grips would stay behind.
    if (editor.view().shown().follows() || !marks.grips[k].faces_eye(pen.projection())) continue;
    const auto pixel = pen.projection().to_pixel(marks.grips[k].position);
    if (!pixel) continue;
    pen.dot(*pixel, marks.grip == k ? kHighlight : kLine);
    if (marks.grip == k) pen.text(*pixel, {14.0, 14.0}, "Drag to resize");
  }
  if (marks.brush_pt > 0.0) pen.circle(cursor, marks.brush_pt, kLine);
  pen.line(marks.outline, true, kLine, 1.5);
}

// Draws one end of each pair: 0 on the source, 1 on the target.
void draw_ends(Pen& pen, const CoatSource& source, std::size_t end, std::optional<Index> half,
               const Positions& positions) {
  const auto mark = [&](Index vertex, ImU32 color, const std::string& name) {
    if (vertex >= positions.size()) return;
    const auto pixel = pen.projection().to_pixel(positions[vertex]);
    if (!pixel) return;
    pen.dot(*pixel, color);
    if (!name.empty()) pen.text(*pixel, {8.0, -8.0}, name);
  };
  for (std::size_t p = 0; p < source.inner_pairs.size(); ++p) {
    mark(source.inner_pairs[p][end], kHighlight, std::to_string(p + 1));
  }
  for (std::size_t p = 0; p < source.boundary_pairs.size(); ++p) {
    mark(source.boundary_pairs[p][end], kPointer, "Border " + std::to_string(p + 1));
  }
  if (half) mark(*half, kLine, "");
}

}  // namespace

void EditMarks::draw(const DetailTransferTool& desk, const Editor& editor, const ViewFrame& view,
                     const Vector2d& corner, double pixels_per_unit) {
  if (desk.view() == nullptr) return;
  const CoatSource& source = desk.draft().sources[desk.current()];
  Pen beside(desk.view()->view_frame(), pixels_per_unit, points_, corner);
  draw_ends(beside, source, 0, desk.picked_source(), desk.view()->shown().positions());
  // On other triangles the vertex numbers mean nothing.
  if (!editor.view().shown().has_triangles_of_state()) return;
  Pen pen(view, pixels_per_unit, points_);
  draw_ends(pen, source, 1, desk.picked_target(), editor.view().positions());
}

void EditMarks::draw(const WrapTool& wrap, const Editor& editor, const ViewFrame& view,
                     const Vector2d& corner, double pixels_per_unit) {
  if (wrap.view() == nullptr) return;
  const bool is_on_template = editor.view().shown().has_triangles_of_state();
  const Positions& positions = editor.view().positions();
  Pen beside(wrap.view()->view_frame(), pixels_per_unit, points_, corner);
  Pen pen(view, pixels_per_unit, points_);
  const Vector2d pane = wrap.view()->view_frame().size;
  const auto mark = [&](Pen& on, const Eigen::Vector3d& place, std::size_t number) {
    const auto pixel = on.projection().to_pixel(place);
    // Marks must not cover the other pane.
    if (!pixel || (&on == &beside) != (pixel->x() < (&on == &beside ? 0.0 : corner.x()) + pane.x()))
      return;
    on.dot(*pixel, ImGui::GetColorU32(color_of_pair(number)));
    on.text(*pixel, {8.0, -8.0}, std::to_string(number + 1));
  };
  const std::span<const Target> landmarks = wrap.landmarks();
  for (std::size_t k = 0; k < landmarks.size(); ++k) {
    mark(beside, landmarks[k].position, k);
    if (is_on_template) mark(pen, point_of(landmarks[k], positions), k);
  }
  const std::size_t next = wrap.moved().value_or(landmarks.size());
  if (wrap.picked_on_scan()) mark(beside, *wrap.picked_on_scan(), next);
  const auto vertex = wrap.picked_on_template();
  if (vertex && is_on_template) mark(pen, positions[*vertex], next);
}

void EditMarks::draw_panes(const std::string& left, const std::string& right,
                           const PictureArea& area, double width) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const double gap = 0.7 * static_cast<double>(ImGui::GetFontSize());
  const ImVec2 seam = to_imgui(area.corner + Vector2d(width, 0.0));
  list.AddLine({seam.x, 0.0F}, {seam.x, ImGui::GetMainViewport()->Size.y}, kShade, 3.0F);
  list.AddLine({seam.x, 0.0F}, {seam.x, ImGui::GetMainViewport()->Size.y}, kLine, 1.0F);
  draw_words(list, area.corner + Vector2d(gap, gap), left);
  draw_words(list, area.corner + Vector2d(width + gap, gap), right);
}

void EditMarks::draw(const Editor& editor, const ViewFrame& view, double pixels_per_unit,
                     const Vector2d& cursor) {
  Pen pen(view, pixels_per_unit, points_);
  const bool pulls = editor.tool().tools().gizmo.orientation() == HandleOrientation::free;
  if (editor.tool().has_gizmo() || (editor.tool().tools().gizmo.is_dragging() && !pulls)) {
    draw_gizmo(pen, editor, gizmo_, readout_);
  }
  draw_mirror(pen, editor);
  draw_pins(pen, editor);
  draw_ruler(pen, editor, readout_);
  draw_marks(pen, editor, cursor);
  for (const Vector2d& pixel : pen.pixels_of(editor, editor.view().pointed_at())) {
    pen.circle(pixel, 14.0, kPointer);
  }
}

void EditMarks::draw_slider(const ViewFrame& view, double pixels_per_unit, double line,
                            double top) {
  Pen pen(view, pixels_per_unit, points_);
  const std::array<Vector2d, 2> ends{Vector2d(line, 0.0), Vector2d(line, view.size.y())};
  pen.line(ends, false, kLine, 1.5);
  pen.dot({line, 0.5 * view.size.y()}, kLine);
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const double gap = 0.7 * static_cast<double>(ImGui::GetFontSize());
  const Vector2d place = Vector2d(line, top) / pixels_per_unit + Vector2d(0.0, gap);
  readout_ = "Original";
  const double width = static_cast<double>(ImGui::CalcTextSize(readout_.c_str()).x);
  draw_words(list, place - Vector2d(width + gap, 0.0), readout_);
  readout_ = "Edited";
  draw_words(list, place + Vector2d(gap, 0.0), readout_);
}

void EditMarks::draw_transplant(const TransplantTool& desk, const ViewFrame& view,
                                double pixels_per_unit) {
  const PlaceTool& tool = desk.tool();
  if (!desk.has_part() || !tool.draft().stands) return;
  Pen pen(view, pixels_per_unit, points_);
  pen.line(pen.pixels_of(desk.hole()), true, kHole, 1.5);
  const auto loop = transformed(tool.draft().part->loop, tool.draft().placement);
  pen.line(pen.pixels_of(loop), true, kHighlight, 1.5);
  if (const auto gizmo = tool.gizmo()) draw_gizmo(pen, *gizmo, tool.part(), gizmo_);
}

}  // namespace lapwing::viewer
