#include <imgui.h>

#include "ui/panels.h"
#include "ui/part_colors.h"

namespace lapwing::viewer {
namespace {

// The colour of carried objects (shaders/carried.glsl).
const ImVec4 kCarriedColor{0.36F, 0.68F, 0.58F, 1.0F};

// Returns true if the object's button was pressed.
bool draw_object(const CarriedObject& object, std::size_t number) {
  ImGui::PushID(static_cast<int>(number));
  const char* verb = object.follows ? "Remove" : "Follow";
  draw_swatch(kCarriedColor);
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(object.file().filename().c_str());
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", object.file().c_str());
  const std::size_t count = object.rest->positions().size();
  ImGui::TextDisabled("%zu %s%s", count, count == 1 ? "vertex" : "vertices",
                      object.follows ? "" : ", stays");
  ImGui::SameLine(ImGui::GetContentRegionMax().x - ImGui::CalcTextSize("Remove").x -
                  2.0F * ImGui::GetStyle().FramePadding.x);
  const bool pressed = ImGui::SmallButton(verb);
  ImGui::PopID();
  return pressed;
}

}  // namespace

std::optional<Action> draw_carried_panel(Editor& editor) {
  std::optional<Action> wanted;
  std::optional<std::size_t> pressed;
  const std::vector<CarriedObject>& objects = editor.state().carried;
  if (objects.empty()) ImGui::TextDisabled("Files that follow the surface.");
  for (std::size_t k = 0; k < objects.size(); ++k) {
    if (draw_object(objects[k], k)) pressed = k;
  }
  if (ImGui::Button("Add...")) wanted = Action::carry_file;
  if (!objects.empty()) {
    ImGui::SameLine();
    if (ImGui::Button("Save carried objects")) wanted = Action::save_carried;
  }
  if (pressed) {
    const CarriedObject object = objects[*pressed];
    if (object.follows) {
      editor.perform(StopCarrying{object.file()});
    } else {
      editor.perform(CarryAlong{object.rest});
    }
  }
  return wanted;
}

}  // namespace lapwing::viewer
