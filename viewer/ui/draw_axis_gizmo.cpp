#include "ui/draw_axis_gizmo.h"

#include <array>
#include <imgui.h>

#include "navigation/axis_gizmo.h"
#include "ui/draw_gizmo.h"
#include "ui/widgets.h"

namespace lapwing::viewer {
namespace {

constexpr ImU32 kAxisGround = IM_COL32(20, 20, 24, 90);
constexpr ImU32 kAxisLetter = IM_COL32(10, 10, 12, 255);
constexpr std::array kAxisLetters{"X", "Y", "Z"};
constexpr float kAxisLinePt = 2.0F;

// Draws the positive end as a disk with its letter, and the negative end as a ring.
void draw_end(ImDrawList& list, const AxisEnd& end, const Eigen::Vector2d& center, double unit) {
  const auto axis = static_cast<std::size_t>(end.axis);
  const ImU32 color = kAxisColors[axis];
  const ImVec2 place = to_imgui(center + unit * end.offset_pt);
  const float radius = static_cast<float>(unit * kAxisEndPt);
  const float width = static_cast<float>(unit) * kAxisLinePt;
  if (!end.positive) {
    list.AddCircleFilled(place, radius, kAxisGround);
    list.AddCircle(place, radius - 0.5F * width, color, 0, width);
    return;
  }
  list.AddLine(to_imgui(center), place, color, width);
  list.AddCircleFilled(place, radius, color);
  const ImVec2 size = ImGui::CalcTextSize(kAxisLetters[axis]);
  list.AddText({place.x - 0.5F * size.x, place.y - 0.5F * size.y}, kAxisLetter, kAxisLetters[axis]);
}

}  // namespace

void draw_axis_gizmo(const Camera& camera, const Eigen::Vector2d& center, double units_per_point) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  list.AddCircleFilled(to_imgui(center), static_cast<float>(units_per_point * kAxisGizmoPt),
                       kAxisGround);
  for (const AxisEnd& end : axis_ends(camera)) draw_end(list, end, center, units_per_point);
}

}  // namespace lapwing::viewer
