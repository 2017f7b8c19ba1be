#include <cstdio>
#include <imgui.h>

#include "ui/panels.h"

namespace lapwing::viewer {
namespace {

void row(const char* label, const std::string& value) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextDisabled("%s", label);
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(value.c_str());
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

ImVec4 color_of(Severity severity) {
  switch (severity) {
    case Severity::error:
      return {0.95F, 0.42F, 0.38F, 1.0F};
    case Severity::warning:
      return {0.95F, 0.76F, 0.30F, 1.0F};
    case Severity::info:
      break;
  }
  return ImGui::GetStyleColorVec4(ImGuiCol_Text);
}

void draw_defect(const Defect& defect) {
  const DefectInfo& info = describe(defect.kind);
  ImGui::PushStyleColor(ImGuiCol_Text, color_of(info.severity));
  ImGui::Bullet();
  ImGui::TextWrapped("%zu %s", defect.count, std::string(info.name).c_str());
  ImGui::PopStyleColor();
  if (!ImGui::IsItemHovered()) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(ImGui::GetFontSize() * 28.0F);
  ImGui::TextUnformatted(info.meaning.data(), info.meaning.data() + info.meaning.size());
  if (!info.next_step.empty()) {
    ImGui::TextDisabled("%s", std::string(info.next_step).c_str());
  }
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

}  // namespace

void draw_mesh_panel(const Document& document) {
  const MeshStatistics& s = document.report.statistics;
  if (ImGui::BeginTable("mesh", 2, ImGuiTableFlags_SizingFixedFit)) {
    row("name", document.opened.name);
    row("vertices", std::to_string(s.vertices));
    row("faces", std::to_string(s.faces));
    if (s.triangles != s.faces) row("triangles", std::to_string(s.triangles));
    row("parts", std::to_string(s.component_sizes.size()));
    row("boundaries", std::to_string(s.boundary_loops));
    if (s.genus) row("genus", std::to_string(*s.genus));
    const Eigen::Vector3d size = s.bounds.max - s.bounds.min;
    row("size", number(size.x()) + " x " + number(size.y()) + " x " + number(size.z()));
    row("mean edge", number(s.mean_edge_length));
    ImGui::EndTable();
  }
  if (!document.report.has_problems()) ImGui::TextDisabled("The mesh doctor finds no problem.");
  for (const Defect& defect : document.report.defects) draw_defect(defect);
}

void draw_timings_panel(const FrameTimings& timings) {
  if (!ImGui::BeginTable("timings", 2, ImGuiTableFlags_SizingFixedFit)) return;
  const auto ms = [](double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2f ms", value);
    return std::string(text);
  };
  row("blend, device", ms(timings.blend_ms));
  row("normals, device", ms(timings.normals_ms));
  row("surface, device", ms(timings.draw_ms));
  row("panels, device", ms(timings.ui_ms));
  row("panels, processor", ms(timings.panels_ms));
  row("frame, processor", ms(timings.frame_ms));
  ImGui::EndTable();
}

void draw_log_panel(std::span<const std::string> messages) {
  for (const std::string& message : messages) ImGui::TextWrapped("%s", message.c_str());
  if (messages.empty()) ImGui::TextDisabled("Nothing to report.");
}

}  // namespace lapwing::viewer
