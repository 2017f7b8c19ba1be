#include <algorithm>
#include <array>
#include <imgui.h>

#include "ui/panels.h"

namespace lapwing::viewer {

bool draw_picture_panel(PicturePlan& plan) {
  ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), ImGuiCond_Appearing, {0.5F, 0.5F});
  bool save = false;
  const bool shown = ImGui::Begin("Save a picture", &plan.open,
                                  ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse);
  if (shown) {
    std::array<int, 2> size{plan.width, plan.height};
    if (ImGui::InputInt2("pixels", size.data())) {
      plan.width = std::max(1, size[0]);
      plan.height = std::max(1, size[1]);
    }
    const bool enters = !ImGui::IsAnyItemActive() && !ImGui::IsWindowAppearing() &&
                        ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Enter), false);
    save = ImGui::Button("Save as...") || enters;
    if (save) plan.open = false;
  }
  ImGui::End();
  return save;
}

}  // namespace lapwing::viewer
