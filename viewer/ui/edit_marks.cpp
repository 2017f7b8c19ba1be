#include <array>
#include <filesystem>
#include <imgui.h>
#include <utility>

#include "ui/panels.h"

namespace lapwing::viewer {
namespace {

using Eigen::Vector2d;

constexpr ImU32 kHighlight = IM_COL32(255, 220, 90, 255);
constexpr ImU32 kLine = IM_COL32(255, 240, 200, 255);
constexpr ImU32 kShade = IM_COL32(20, 20, 24, 160);
constexpr ImU32 kGround = IM_COL32(20, 20, 24, 225);
constexpr ImU32 kPointer = IM_COL32(255, 90, 200, 255);
constexpr ImU32 kHole = IM_COL32(90, 190, 255, 255);
constexpr ImU32 kMirror = IM_COL32(90, 190, 255, 28);
constexpr double kThickPt = 2.5;
// Padding around text, in letters of the font.
constexpr float kPaddingLetters = 0.27F;

ImU32 color_of(GizmoPart part) {
  constexpr std::array kAxes{IM_COL32(235, 80, 80, 255), IM_COL32(120, 205, 80, 255),
                             IM_COL32(90, 150, 250, 255)};
  const int axis = axis_of(part);
  return axis < 0 ? IM_COL32(235, 235, 235, 255) : kAxes[static_cast<std::size_t>(axis)];
}

// Draws text on a dark background, so that it is readable over anything.
void draw_words(ImDrawList& list, const Vector2d& place, const std::string& words) {
  const ImVec2 from{static_cast<float>(place.x()), static_cast<float>(place.y())};
  const ImVec2 size = ImGui::CalcTextSize(words.c_str());
  const float padding = kPaddingLetters * ImGui::GetFontSize();
  list.AddRectFilled({from.x - padding, from.y - 0.5F * padding},
                     {from.x + size.x + padding, from.y + size.y + 0.5F * padding}, kGround,
                     ImGui::GetStyle().FrameRounding);
  list.AddText(from, kLine, words.c_str());
}

// Draws at pixels of the picture, with sizes in points.
class Pen {
 public:
  Pen(const ViewFrame& view, double pixels_per_unit, std::vector<Vector2d>& points,
      const Vector2d& corner = Vector2d::Zero())
      : list_(*ImGui::GetBackgroundDrawList()),
        projection_(view.projection()),
        corner_(corner),
        unit_(pixels_per_unit),
        units_per_point_(view.pixels_per_point / pixels_per_unit),
        points_(points) {}

  const Projection& projection() const { return projection_; }

  // A dark line below makes it show on every surface.
  void line(std::span<const Vector2d> pixels, bool closed, ImU32 color, double thickness_pt) {
    if (pixels.size() < 2) return;
    for (const auto& [shade, width_pt] :
         {std::pair{kShade, thickness_pt + 2.0}, std::pair{color, thickness_pt}}) {
      for (const Vector2d& pixel : pixels) list_.PathLineTo(at(pixel));
      list_.PathStroke(shade, closed ? ImDrawFlags_Closed : ImDrawFlags_None, units(width_pt));
    }
  }

  void area(std::span<const Vector2d> pixels, ImU32 color) {
    for (const Vector2d& pixel : pixels) list_.PathLineTo(at(pixel));
    list_.PathFillConvex(color);
  }

  void circle(const Vector2d& pixel, double radius_pt, ImU32 color) {
    list_.AddCircle(at(pixel), units(radius_pt), kShade, 0, units(kThickPt + 1.0));
    list_.AddCircle(at(pixel), units(radius_pt), color, 0, units(kThickPt - 1.0));
  }

  void dot(const Vector2d& pixel, ImU32 color) {
    list_.AddCircleFilled(at(pixel), units(5.0), kShade);
    list_.AddCircleFilled(at(pixel), units(4.0), color);
  }

  // Draws text to the right of the pixel and below it.
  void text(const Vector2d& pixel, const Vector2d& offset_pt, const std::string& words) {
    draw_words(list_, (corner_ + pixel) / unit_ + units_per_point_ * offset_pt, words);
  }

  // Returns the pixels of points, valid until the next call.
  std::span<const Vector2d> pixels_of(std::span<const Eigen::Vector3d> points) {
    points_.clear();
    for (const Eigen::Vector3d& point : points) {
      if (const auto pixel = projection_.to_pixel(point)) points_.push_back(*pixel);
    }
    return points_;
  }

  // Returns the pixels of vertices, valid until the next call.
  std::span<const Vector2d> pixels_of(const Editor& editor, std::span<const Index> vertices) {
    points_.clear();
    for (const Index v : vertices) {
      if (const auto pixel = projection_.to_pixel(editor.positions()[v])) points_.push_back(*pixel);
    }
    return points_;
  }

 private:
  ImVec2 at(const Vector2d& pixel) const {
    const Vector2d place = (corner_ + pixel) / unit_;
    return {static_cast<float>(place.x()), static_cast<float>(place.y())};
  }

  float units(double points) const { return static_cast<float>(units_per_point_ * points); }

  ImDrawList& list_;
  const Projection projection_;
  const Vector2d corner_;
  const double unit_;  // ImGui's unit, in pixels
  const double units_per_point_;
  std::vector<Vector2d>& points_;
};

// Draws a box at the end of an arm that scales, an arrowhead at one that moves.
void draw_arm_end(Pen& pen, const GizmoLine& line, GizmoMode mode, ImU32 color) {
  constexpr double kHalfWidthPt = 5.0;
  constexpr double kHeadPt = 12.0;
  const Vector2d& end = line.pixels.back();
  const Vector2d direction = (end - line.pixels.front()).normalized();
  const Vector2d along = pen.projection().in_pixels(kHalfWidthPt) * direction;
  const Vector2d across(-along.y(), along.x());
  if (mode == GizmoMode::scale) {
    const std::array<Vector2d, 4> box{end - along - across, end + along - across,
                                      end + along + across, end - along + across};
    pen.area(box, color);
  } else {
    const Vector2d tip = end + pen.projection().in_pixels(kHeadPt) * direction;
    pen.area(std::array<Vector2d, 3>{tip, end + across, end - across}, color);
  }
}

// `taken_part` is under the cursor, or dragged.
void draw_gizmo(Pen& pen, const Gizmo& gizmo, GizmoPart taken_part, GizmoLines& lines) {
  lines.renew(gizmo, pen.projection());
  for (const GizmoLine& line : lines.lines()) {
    if (line.pixels.size() < 2) continue;
    const bool taken = line.part == taken_part;
    const ImU32 color = taken ? kHighlight : color_of(line.part);
    if (is_plane(line.part)) {
      pen.area(line.pixels, (color & ~IM_COL32_A_MASK) | IM_COL32(0, 0, 0, taken ? 170 : 90));
    }
    pen.line(line.pixels, line.closed, color, kThickPt);
    const bool arm = !line.closed && axis_of(line.part) >= 0 && !is_plane(line.part);
    if (arm && gizmo.mode != GizmoMode::rotate) draw_arm_end(pen, line, gizmo.mode, color);
  }
}

void draw_gizmo(Pen& pen, const Editor& editor, GizmoLines& lines, std::string& readout) {
  const GizmoTool& tool = editor.gizmo_tool();
  const Gizmo gizmo = tool.gizmo(editor.state(), editor.handle());
  draw_gizmo(pen, gizmo, tool.part(), lines);
  if (!tool.is_dragging()) return;
  if (const auto center = pen.projection().to_pixel(gizmo.center)) {
    tool.read_out(readout);
    pen.text(*center, {24.0, 24.0}, readout);
  }
}

void draw_ruler(Pen& pen, const Editor& editor, std::string& readout) {
  const RulerTool& ruler = editor.ruler_tool();
  if (!ruler.has_both_ends() || !editor.shown().has_triangles_of_state()) return;
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
  if (!editor.shown().has_triangles_of_state()) return;
  const AppState& state = editor.state();
  const auto& followed = editor.shown().followed();
  const auto draw = [&](std::size_t h, const VertexSet& vertices) {
    if (vertices.size() != 1) return;
    const Index v = vertices.front();
    const Eigen::Vector3d place = h < followed.size()
                                      ? Eigen::Vector3d(followed[h] * state.rest->positions[v])
                                      : editor.positions()[v];
    const auto pixel = pen.projection().to_pixel(place);
    if (pixel) pen.dot(*pixel, editor.handle() == h ? kHighlight : kLine);
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
  const Bounds& bounds = editor.shown().opened_bounds();
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
  const ToolMarks marks = editor.tool().marks();
  const ImU32 color = marks.line_is_done ? kHighlight : kLine;
  pen.line(pen.pixels_of(editor, marks.line), false, color, kThickPt);
  for (const Vector2d& dot : pen.pixels_of(editor, marks.dots)) pen.dot(dot, kHighlight);
  for (std::size_t k = 0; k < marks.grips.size(); ++k) {
    // On a surface that is being moved the grips would stay behind.
    if (editor.shown().follows() || !marks.grips[k].faces_eye(pen.projection())) continue;
    const auto pixel = pen.projection().to_pixel(marks.grips[k].position);
    if (!pixel) continue;
    pen.dot(*pixel, marks.grip == k ? kHighlight : kLine);
    if (marks.grip == k) pen.text(*pixel, {14.0, 14.0}, "drag to size the disk");
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
    mark(source.boundary_pairs[p][end], kPointer, "border " + std::to_string(p + 1));
  }
  if (half) mark(*half, kLine, "");
}

}  // namespace

void EditMarks::draw(const DetailTransferTool& desk, const Editor& editor, const ViewFrame& view,
                     const Vector2d& corner, double pixels_per_unit) {
  if (desk.view() == nullptr) return;
  const double right = corner.x() + desk.view()->view_frame().size.x();
  const std::array<Vector2d, 2> seam{Vector2d(right, 0.0), Vector2d(right, view.size.y())};
  Pen(view, pixels_per_unit, points_).line(seam, false, kLine, 1.0);
  const CoatSource& source = desk.draft().sources[desk.current()];
  Pen beside(desk.view()->view_frame(), pixels_per_unit, points_, corner);
  draw_ends(beside, source, 0, desk.picked_source(), desk.view()->shown().positions());
  // On other triangles the vertex numbers mean nothing.
  if (!editor.shown().has_triangles_of_state()) return;
  Pen pen(view, pixels_per_unit, points_);
  draw_ends(pen, source, 1, desk.picked_target(), editor.positions());
}

void EditMarks::draw_pane_names(const DetailTransferTool& desk, const std::string& target,
                                const PictureArea& area, double width) {
  const std::filesystem::path& mesh = desk.draft().sources[desk.current()].mesh;
  const double gap = 0.7 * static_cast<double>(ImGui::GetFontSize());
  readout_ = desk.draft().source_count() == 1 ? "source: "
             : desk.current() == 0            ? "first source: "
                                              : "second source: ";
  readout_ += mesh.empty() ? "this mesh" : mesh.filename().string();
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  draw_words(list, area.corner + Vector2d(gap, gap), readout_);
  readout_ = "target: " + target;
  draw_words(list, area.corner + Vector2d(width + gap, gap), readout_);
}

void EditMarks::draw(const Editor& editor, const ViewFrame& view, double pixels_per_unit,
                     const Vector2d& cursor) {
  Pen pen(view, pixels_per_unit, points_);
  if (editor.has_gizmo() || editor.gizmo_tool().is_dragging()) {
    draw_gizmo(pen, editor, gizmo_, readout_);
  }
  draw_mirror(pen, editor);
  draw_pins(pen, editor);
  draw_ruler(pen, editor, readout_);
  draw_marks(pen, editor, cursor);
  for (const Vector2d& pixel : pen.pixels_of(editor, editor.pointed_at())) {
    pen.circle(pixel, 14.0, kPointer);
  }
}

void EditMarks::draw_transplant(const TransplantDesk& desk, const ViewFrame& view,
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
