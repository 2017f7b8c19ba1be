#include <algorithm>
#include <cstdio>
#include <imgui.h>

#include "ui/explain.h"
#include "ui/panels.h"
#include "window/theme.h"

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

// Adds rows for the colours in the mesh's file.
void color_rows(const OpenedMesh& opened) {
  const MeshAttributes& attributes = opened.mesh->attributes();
  if (!attributes.vertex_colors.empty()) row("colours", "of vertices");
  if (!attributes.face_colors.empty()) row("colours", "of faces");
  if (!opened.colors || opened.colors->colors.materials.empty()) return;
  const std::vector<FileMaterial>& materials = opened.colors->colors.materials;
  const auto with_image = std::ranges::count_if(
      materials, [](const FileMaterial& material) { return material.image != kNoIndex; });
  row("materials",
      std::to_string(materials.size()) + " (with images: " + std::to_string(with_image) + ")");
}

Tone tone_of(Severity severity) {
  return severity == Severity::error     ? Tone::error
         : severity == Severity::warning ? Tone::warning
                                         : Tone::note;
}

void draw_defect(const Defect& defect) {
  const DefectInfo& info = describe(defect.kind);
  ImGui::PushStyleColor(ImGuiCol_Text, text_color(tone_of(info.severity)));
  ImGui::Bullet();
  ImGui::TextWrapped("%zu %s", defect.count, std::string(info.name).c_str());
  ImGui::PopStyleColor();
  explain(info.meaning, info.next_step);
}

}  // namespace

void draw_mesh_panel(const Document& document, const std::string& unit) {
  const MeshStatistics& s = document.report.statistics;
  const std::string behind = unit.empty() ? "" : " " + unit;
  if (ImGui::BeginTable("mesh", 2, ImGuiTableFlags_SizingFixedFit)) {
    row("name", document.opened.name);
    row("vertices", std::to_string(s.vertices));
    row("faces", std::to_string(s.faces));
    if (s.triangles != s.faces) row("triangles", std::to_string(s.triangles));
    row("parts", std::to_string(s.component_sizes.size()));
    row("boundaries", std::to_string(s.boundary_loops));
    if (s.genus) row("genus", std::to_string(*s.genus));
    const Eigen::Vector3d size = s.bounds.max - s.bounds.min;
    row("size", number(size.x()) + " x " + number(size.y()) + " x " + number(size.z()) + behind);
    row("mean edge", number(s.mean_edge_length) + behind);
    color_rows(document.opened);
    ImGui::EndTable();
  }
  if (!document.report.has_problems()) ImGui::TextDisabled("The mesh doctor finds no problem.");
  for (const Defect& defect : document.report.defects) draw_defect(defect);
}

}  // namespace lapwing::viewer
