#include <imgui.h>

#include "tools/guide.h"
#include "ui/panels.h"

namespace lapwing::viewer {

void draw_guide(const Editor& editor, const Eigen::Vector2d& corner) {
  constexpr ImGuiWindowFlags kOverPicture =
      ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs |
      ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings |
      ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav;
  const bool moves = editor.has_in_hand(editor.gizmo_tool());
  const Guide guide = guide_of(editor.state(), editor.part(), editor.tool(), moves);
  ImGui::SetNextWindowPos({static_cast<float>(corner.x()), static_cast<float>(corner.y())});
  ImGui::SetNextWindowBgAlpha(0.96F);
  if (ImGui::Begin("Guide", nullptr, kOverPicture)) {
    for (std::size_t k = 0; k < guide.steps.size(); ++k) {
      if (k > 0) ImGui::SameLine(0.0F, 1.5F * ImGui::GetFontSize());
      const Guide::Step& step = guide.steps[k];
      const char* done = step.is_done ? " (done)" : "";
      if (k == guide.current) {
        ImGui::Text("%zu  %s%s", k + 1, step.name, done);
      } else {
        ImGui::TextDisabled("%zu  %s%s", k + 1, step.name, done);
      }
    }
    ImGui::TextUnformatted(guide.what);
  }
  ImGui::End();
}

}  // namespace lapwing::viewer
