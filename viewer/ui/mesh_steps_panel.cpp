// Draws the commands of the Mesh tab: fill holes, remesh, decimate and subdivide.

#include <algorithm>
#include <cstdio>
#include <imgui.h>

#include "lapwing/base/counted.h"
#include "lapwing/base/printable_text.h"
#include "ui/panels.h"
#include "ui/parameter_panel.h"
#include "ui/widgets.h"
#include "work/window_words.h"

namespace lapwing::viewer {
namespace {

constexpr float kMostHoleLines = 7.0F;

std::string name_of(const Hole& hole) {
  return grouped(hole.rim.size()) + " rim vertices" + (hole.is_border ? ", border" : "");
}

// Draws the numbers of vertices and faces of the result, or the reason why there is no result.
void draw_result_of(const MeshStepTool& tool, const Editor& editor) {
  const StepPreview& preview = tool.result();
  const WorkStatus status = preview.status();
  if (status.busy) {
    ImGui::ProgressBar(static_cast<float>(status.fraction), {-1.0F, 0.0F},
                       stage_in_words(status.stage).data());
  } else if (!preview.message().empty()) {
    draw_colored(Tone::error, in_window_words(preview.message()));
  } else if (const std::shared_ptr<const Mesh> mesh = preview.mesh()) {
    const Mesh& before = *editor.state().rest;
    ImGui::TextWrapped("Preview: %s vertices (before: %s)", grouped(mesh->vertex_count()).c_str(),
                       grouped(before.vertex_count()).c_str());
    ImGui::TextWrapped("%s faces (before: %s)", grouped(mesh->face_count()).c_str(),
                       grouped(before.face_count()).c_str());
  } else if (preview.result() != nullptr) {
    ImGui::TextWrapped("The step changes nothing. Change its settings.");
  } else {
    ImGui::TextDisabled("Waiting for the last edit.");
  }
  if (preview.result() == nullptr) return;
  for (const std::string& warning : preview.result()->warnings) {
    draw_colored(Tone::warning, in_window_words(warning));
  }
}

template <class Request>
bool is_open(const MeshStepTool& tool) {
  return tool.step() != nullptr && std::holds_alternative<Request>(*tool.step());
}

// Draws the parameters of a command and the button that previews it. Follows changes of the
// parameters while the preview is open.
template <class Request>
void draw_command(MeshStepTool& tool, Request& request, const char* verb, double size) {
  ImGui::PushID(verb);
  ParameterPanel panel(size);
  describe(request, panel);
  if (ImGui::Button(verb) || (panel.chosen() && is_open<Request>(tool))) tool.preview(request);
  explain("Shows a preview.");
  ImGui::PopID();
}

// Draws one row per hole. Returns the rim of the hole to show.
std::optional<std::vector<Index>> draw_hole_rows(MeshStepTool& tool,
                                                 const std::vector<Hole>& holes) {
  std::optional<std::vector<Index>> shown;
  const float lines = std::min(static_cast<float>(holes.size()), kMostHoleLines);
  ImGui::BeginChild("holes", {0.0F, lines * ImGui::GetFrameHeightWithSpacing()});
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(holes.size()));
  while (clipper.Step()) {
    for (int k = clipper.DisplayStart; k < clipper.DisplayEnd; ++k) {
      const Hole& hole = holes[static_cast<std::size_t>(k)];
      ImGui::PushID(k);
      ImGui::AlignTextToFramePadding();
      ImGui::TextUnformatted(name_of(hole).c_str());
      if (!hole.trouble.empty()) explain("Cannot be filled: " + in_window_words(hole.trouble));
      ImGui::SameLine(ImGui::GetContentRegionMax().x - button_width("Show") - button_width("Fill") -
                      ImGui::GetStyle().ItemSpacing.x);
      if (ImGui::Button("Show")) shown = hole.rim;
      ImGui::SameLine();
      ImGui::BeginDisabled(!hole.trouble.empty());
      if (ImGui::Button("Fill")) {
        FillRequest request = tool.drafts.fill;
        request.region = {ListedVertices{{hole.rim.front()}}};
        request.largest = 0;
        request.borders = hole.is_border;
        tool.preview(request);
      }
      ImGui::EndDisabled();
      ImGui::PopID();
    }
  }
  ImGui::EndChild();
  return shown;
}

std::optional<std::vector<Index>> draw_holes(MeshStepTool& tool, double size) {
  if (tool.report() == nullptr) {
    ImGui::TextDisabled("Looking for holes...");
    return {};
  }
  const std::vector<Hole>& holes = tool.report()->holes;
  if (holes.empty()) {
    ImGui::TextDisabled("The surface is closed.");
    return {};
  }
  draw_command(tool, tool.drafts.fill, "Fill all", size);
  return draw_hole_rows(tool, holes);
}

void draw_remesh(MeshStepTool& tool, const Editor& editor, double size) {
  const ChosenRegion& roi = editor.state().selection.roi;
  MeshStepDrafts& drafts = tool.drafts;
  if (roi.vertices.empty()) {
    drafts.only_region = false;
  } else {
    ImGui::Checkbox("Region only", &drafts.only_region);
  }
  drafts.remesh.region =
      drafts.only_region ? spec_of(roi, "the region") : RegionSpec{AllVertices{}};
  draw_command(tool, drafts.remesh, "Remesh", size);
}

}  // namespace

std::optional<std::vector<Index>> draw_mesh_steps(MeshStepTool& tool, const Editor& editor,
                                                  double size) {
  std::optional<std::vector<Index>> shown;
  if (ImGui::CollapsingHeader("Holes")) shown = draw_holes(tool, size);
  if (ImGui::CollapsingHeader("Remeshing")) draw_remesh(tool, editor, size);
  if (ImGui::CollapsingHeader("Decimation")) {
    draw_command(tool, tool.drafts.decimate, "Decimate", size);
  }
  if (ImGui::CollapsingHeader("Subdivision")) {
    draw_command(tool, tool.drafts.subdivide, "Subdivide", size);
  }
  return shown;
}

void draw_mesh_step_result(MeshStepTool& tool, Editor& editor) {
  if (tool.result().mesh() != nullptr) {
    if (ImGui::Button("Apply")) return tool.apply(editor);
    explain("Adds the previewed change as a step.");
    ImGui::SameLine();
  }
  if (ImGui::Button("Cancel")) return tool.close(editor);
  explain("Discards the preview.", "Shortcut: Escape");
  draw_result_of(tool, editor);
}

}  // namespace lapwing::viewer
