#include <imgui.h>

#include "ui/panels.h"

namespace lapwing::viewer {

double draw_guide(const Guide& guide, const PictureArea& area) {
  constexpr ImGuiWindowFlags kOverPicture =
      ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs |
      ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings |
      ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav;
  const float gap = 0.5F * ImGui::GetFontSize();
  ImGui::SetNextWindowPos({static_cast<float>(area.corner.x()) + gap,
                           static_cast<float>(area.corner.y() + area.size.y()) - gap},
                          ImGuiCond_Always, {0.0F, 1.0F});
  if (ImGui::Begin("Guide", nullptr, kOverPicture)) {
    ImGui::PushTextWrapPos(static_cast<float>(area.size.x()) - 2.0F * gap -
                           2.0F * ImGui::GetStyle().WindowPadding.x);
    for (std::size_t k = 0; k < guide.count; ++k) {
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
    ImGui::PopTextWrapPos();
  }
  const double height = static_cast<double>(ImGui::GetWindowHeight() + gap);
  ImGui::End();
  return height;
}

}  // namespace lapwing::viewer
