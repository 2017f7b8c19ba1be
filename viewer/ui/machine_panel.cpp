#include <imgui.h>

#include "ui/panels.h"

namespace lapwing::viewer {
namespace {

constexpr float kWidthLetters = 26.0F;

void row(const char* label, const char* format, auto value) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextDisabled("%s", label);
  ImGui::TableNextColumn();
  ImGui::TextWrapped(format, value);
}

}  // namespace

void draw_timings_panel(const FrameTimings& timings) {
  if (!ImGui::BeginTable("timings", 2, ImGuiTableFlags_SizingFixedFit)) return;
  row("blend, device", "%.2f ms", timings.blend_ms);
  row("normals, device", "%.2f ms", timings.normals_ms);
  row("surface, device", "%.2f ms", timings.draw_ms);
  row("panels, device", "%.2f ms", timings.ui_ms);
  row("panels, processor", "%.2f ms", timings.panels_ms);
  row("frame, processor", "%.2f ms", timings.frame_ms);
  ImGui::EndTable();
}

void draw_machine_panel(const gpu::DeviceDescription& device, const FrameTimings& timings,
                        const Certificate* certificate, bool& open) {
  ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), ImGuiCond_Appearing, {0.5F, 0.5F});
  ImGui::SetNextWindowSize({kWidthLetters * ImGui::GetFontSize(), 0.0F}, ImGuiCond_Appearing);
  if (ImGui::Begin("Machine", &open, ImGuiWindowFlags_NoCollapse)) {
    if (ImGui::BeginTable("device", 2)) {
      ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthFixed);
      ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch);
      row("device", "%s", device.name.c_str());
      row("kind", "%s", device.type.c_str());
      row("driver", "%s", device.driver.c_str());
      row("Vulkan", "%s", device.api_version.c_str());
      if (certificate != nullptr) {
        row("residual", "%.1e", certificate->relative_residual);
        row("gradient left", "%.1e", certificate->relative_gradient);
      }
      ImGui::EndTable();
    }
    ImGui::Separator();
    ImGui::TextDisabled("the last frame");
    draw_timings_panel(timings);
  }
  ImGui::End();
}

}  // namespace lapwing::viewer
