// Draws the Mesh tab.

#include <algorithm>
#include <cstdio>
#include <imgui.h>

#include "lapwing/base/counted.h"
#include "ui/panels.h"
#include "ui/widgets.h"
#include "window/theme.h"
#include "work/window_words.h"

namespace lapwing::viewer {
namespace {

// This must be the colour of carried objects in shaders/target.glsl.
const ImVec4 kCarriedColor{0.36F, 0.68F, 0.58F, 1.0F};

// Returns true if the object's button was pressed.
bool draw_object(const CarriedObject& object, std::size_t number) {
  ImGui::PushID(static_cast<int>(number));
  const char* verb = object.follows ? "Detach" : "Attach";
  draw_swatch(kCarriedColor);
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(object.file().filename().c_str());
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", object.file().c_str());
  const std::size_t count = object.rest->positions().size();
  ImGui::TextDisabled("%zu %s%s", count, count == 1 ? "vertex" : "vertices",
                      object.follows ? "" : ", detached");
  ImGui::SameLine(ImGui::GetContentRegionMax().x - ImGui::CalcTextSize("Detach").x -
                  2.0F * ImGui::GetStyle().FramePadding.x);
  const bool pressed = ImGui::SmallButton(verb);
  ImGui::PopID();
  return pressed;
}

void mesh_row(const char* label, const std::string& value) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextDisabled("%s", label);
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(value.c_str());
}

// Also shows the number of holes if it differs from that of the boundary loops.
void boundary_row(const CheckReport& report) {
  const std::size_t loops = report.statistics.boundary_loops;
  std::string value = std::to_string(loops);
  if (report.holes.size() != loops) {
    value += " (holes: " + std::to_string(report.holes.size()) + ")";
  }
  mesh_row("Boundaries", value);
  explain(
      "Closed loops of edges that belong to one face only.",
      "A loop that touches itself counts as several holes. A loop along an unwelded seam is not "
      "a hole.");
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

// Adds rows for the colours in the mesh's file.
void color_rows(const OpenedMesh& opened) {
  const MeshAttributes& attributes = opened.mesh->attributes();
  if (!attributes.vertex_colors.empty()) mesh_row("Colours", "per vertex");
  if (!attributes.face_colors.empty()) mesh_row("Colours", "per face");
  if (!opened.colors || opened.colors->colors.materials.empty()) return;
  const std::vector<FileMaterial>& materials = opened.colors->colors.materials;
  const auto with_image = std::ranges::count_if(
      materials, [](const FileMaterial& material) { return material.image != kNoIndex; });
  mesh_row("Materials",
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
  ImGui::TextWrapped("%s", counted(defect.count, info.name).c_str());
  ImGui::PopStyleColor();
  explain(in_window_words(std::string(info.meaning)), in_window_words(std::string(info.next_step)));
}

}  // namespace

void draw_mesh_panel(const Document& document, const std::string& unit) {
  const CheckReport* report = document.mesh_steps.report();
  if (report == nullptr) return ImGui::TextDisabled("Checking the mesh...");
  const MeshStatistics& s = report->statistics;
  const std::string behind = unit.empty() ? "" : " " + unit;
  if (ImGui::BeginTable("mesh", 2, ImGuiTableFlags_SizingFixedFit)) {
    mesh_row("Opened file", document.opened.name);
    mesh_row("Vertices", std::to_string(s.vertices));
    mesh_row("Faces", std::to_string(s.faces));
    if (s.triangles != s.faces) mesh_row("Triangles", std::to_string(s.triangles));
    mesh_row("Components", std::to_string(s.component_sizes.size()));
    boundary_row(*report);
    if (s.genus) mesh_row("Genus", std::to_string(*s.genus));
    const Eigen::Vector3d size = s.bounds.max - s.bounds.min;
    mesh_row("Size",
             number(size.x()) + " x " + number(size.y()) + " x " + number(size.z()) + behind);
    mesh_row("Mean edge length", number(s.mean_edge_length) + behind);
    color_rows(document.opened);
    ImGui::EndTable();
  }
  if (!report->has_problems()) ImGui::TextDisabled("No problems found.");
  for (const Defect& defect : report->defects) draw_defect(defect);
}

std::optional<Action> draw_carried_panel(Editor& editor) {
  std::optional<Action> wanted;
  std::optional<std::size_t> pressed;
  const std::vector<CarriedObject>& objects = editor.state().carried;
  if (objects.empty()) ImGui::TextDisabled("Attached objects follow the surface.");
  for (std::size_t k = 0; k < objects.size(); ++k) {
    if (draw_object(objects[k], k)) pressed = k;
  }
  if (ImGui::Button("Attach...")) wanted = Action::carry_file;
  if (!objects.empty()) {
    ImGui::SameLine();
    if (ImGui::Button("Save attached objects")) wanted = Action::save_carried;
  }
  if (pressed) {
    const CarriedObject object = objects[*pressed];
    if (object.follows) {
      editor.actions().perform(StopCarrying{object.file()});
    } else {
      editor.actions().perform(CarryAlong{object.rest});
    }
  }
  return wanted;
}

}  // namespace lapwing::viewer
