#include "ui/draw_gizmo.h"

namespace lapwing::viewer {
namespace {

using Eigen::Vector2d;

ImU32 color_of(GizmoPart part) {
  const int axis = axis_of(part);
  return axis < 0 ? IM_COL32(235, 235, 235, 255) : kAxisColors[static_cast<std::size_t>(axis)];
}

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

// In the order of GizmoPivot.
constexpr std::array kPivots{"Handle centre", "Handle rim centre", "Fixed border centre",
                             "Point on the surface", "World origin"};

void draw_pivot(Editor& editor, GizmoChoices& choices) {
  int pivot = static_cast<int>(choices.pivot);
  label_field("Pivot");
  if (ImGui::Combo("##pivot", &pivot, kPivots.data(), static_cast<int>(kPivots.size()))) {
    // There is no pivot point before it is picked.
    if (static_cast<GizmoPivot>(pivot) == GizmoPivot::point) {
      editor.input().begin_picking_pivot();
    } else {
      choices.pivot = static_cast<GizmoPivot>(pivot);
    }
  }
  if (editor.input().picks_pivot()) ImGui::TextWrapped("%s", editor.input().hint());
  if (choices.pivot == GizmoPivot::point && !editor.input().picks_pivot() &&
      ImGui::SmallButton("Pick another point")) {
    editor.input().begin_picking_pivot();
  }
}

}  // namespace

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
  const GizmoTool& tool = editor.tool().tools().gizmo;
  const Gizmo gizmo = tool.gizmo(editor.state(), editor.tool().handle());
  draw_gizmo(pen, gizmo, tool.part(), lines);
  if (!tool.is_dragging()) return;
  if (const auto center = pen.projection().to_pixel(gizmo.center)) {
    tool.read_out(readout);
    pen.text(*center, {24.0, 24.0}, readout);
  }
}

void draw_gizmo_panel(Editor& editor) {
  GizmoMode mode = editor.tool().tools().gizmo.mode();
  if (choose("Gizmo", mode,
             {{"Move", GizmoMode::translate},
              {"Rotate", GizmoMode::rotate},
              {"Scale", GizmoMode::scale}})) {
    editor.tool().tools().gizmo.show(mode);
  }
  GizmoChoices choices = editor.tool().tools().gizmo.choices();
  choose("Orientation", choices.axes,
         {{"World", GizmoAxes::world}, {"Local", GizmoAxes::local}, {"Normal", GizmoAxes::normal}});
  draw_pivot(editor, choices);
  ImGui::Checkbox("Snap to surface", &choices.sticks_to_surface);
  explain("Keeps the centre of the handle on the surface beside the region while you move it.",
          "Shortcut: Shift+Tab");
  editor.tool().tools().gizmo.set_choices(choices);
}

}  // namespace lapwing::viewer
