// Draws the guide over the 3D view, the list of controls, and the panel with the device and the
// timings of a frame.

#include <array>
#include <cstdio>
#include <imgui.h>

#include "ui/panels.h"
#include "ui/widgets.h"

namespace lapwing::viewer {
namespace {

// Text wraps at `right`, in the window's coordinates.
void draw_lines(const char* id, const std::vector<ControlLine>& lines, float right) {
  if (!ImGui::BeginTable(id, 2, ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_RowBg)) return;
  ImGui::PushTextWrapPos(right);
  for (const ControlLine& line : lines) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(line.how.c_str());
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(line.what.c_str());
  }
  ImGui::PopTextWrapPos();
  ImGui::EndTable();
}

constexpr float kWidthLetters = 26.0F;

void row(const char* label, const char* format, auto value) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextDisabled("%s", label);
  ImGui::TableNextColumn();
  ImGui::TextWrapped(format, value);
}

// Times keep their line, however wide the table is.
void time_row(const char* label, double milliseconds) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextDisabled("%s", label);
  ImGui::TableNextColumn();
  ImGui::Text("%.2f ms", milliseconds);
}

void draw_timings(const FrameTimings& timings) {
  if (!ImGui::BeginTable("timings", 2, ImGuiTableFlags_SizingFixedFit)) return;
  time_row("Deformation, GPU", static_cast<double>(timings.blend_ms));
  time_row("Normals, GPU", static_cast<double>(timings.normals_ms));
  time_row("Surface, GPU", static_cast<double>(timings.draw_ms));
  time_row("Panels, GPU", static_cast<double>(timings.ui_ms));
  time_row("Panels, CPU", static_cast<double>(timings.panels_ms));
  time_row("Frame, CPU", static_cast<double>(timings.frame_ms));
  ImGui::EndTable();
}

}  // namespace

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
    const float right = static_cast<float>(area.corner.x() + area.size.x()) - 2.0F * gap -
                        ImGui::GetStyle().WindowPadding.x;
    for (std::size_t k = 0; k < guide.count; ++k) {
      const Guide::Step& step = guide.steps[k];
      std::array<char, 64> name{};
      std::snprintf(name.data(), name.size(), "%zu  %s%s", k + 1, step.name,
                    step.is_done ? " (done)" : "");
      const float between = 1.5F * ImGui::GetFontSize();
      const float width = between + ImGui::CalcTextSize(name.data()).x;
      if (k > 0 && ImGui::GetItemRectMax().x + width <= right) ImGui::SameLine(0.0F, between);
      if (k == guide.current) {
        ImGui::TextUnformatted(name.data());
      } else {
        ImGui::TextDisabled("%s", name.data());
      }
    }
    ImGui::TextUnformatted(guide.what);
    ImGui::PopTextWrapPos();
  }
  const double height = static_cast<double>(ImGui::GetWindowHeight() + gap);
  ImGui::End();
  return height;
}

void draw_controls_list(const Keymap& keymap, bool& open) {
  center_next_window();
  const ImVec2 all = ImGui::GetMainViewport()->WorkSize;
  ImGui::SetNextWindowSizeConstraints({0.0F, 0.0F}, {0.95F * all.x, 0.95F * all.y});
  const bool shown = ImGui::Begin(
      "Controls", &open,
      ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove);
  if (shown) {
    const ImGuiStyle& style = ImGui::GetStyle();
    const float right = 0.95F * all.x - style.WindowPadding.x - style.ScrollbarSize;
    ImGui::TextDisabled("Mouse navigation: %s", std::string(keymap.name).c_str());
    draw_lines("mouse", mouse_controls(keymap), right);
    ImGui::Spacing();
    ImGui::TextDisabled("Keys");
    draw_lines("keys", key_controls(), right);
  }
  ImGui::End();
}

void draw_machine_panel(const gpu::DeviceDescription& device, const FrameTimings& timings,
                        const Certificate* certificate, bool& open) {
  center_next_window(ImGuiCond_Appearing);
  ImGui::SetNextWindowSize({kWidthLetters * ImGui::GetFontSize(), 0.0F}, ImGuiCond_Appearing);
  if (ImGui::Begin("System info", &open, ImGuiWindowFlags_NoCollapse)) {
    if (ImGui::BeginTable("Device", 2)) {
      ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthFixed);
      ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch);
      row("Device", "%s", device.name.c_str());
      row("Type", "%s", device.type.c_str());
      row("Driver", "%s", device.driver.c_str());
      row("Vulkan", "%s", device.api_version.c_str());
      if (certificate != nullptr) {
        row("Residual", "%.1e", certificate->relative_residual);
        row("Residual force", "%.1e", certificate->relative_gradient);
      }
      ImGui::EndTable();
    }
    ImGui::Separator();
    ImGui::TextDisabled("Last frame");
    draw_timings(timings);
  }
  ImGui::End();
}

}  // namespace lapwing::viewer
