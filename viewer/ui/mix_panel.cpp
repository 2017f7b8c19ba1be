#include <imgui.h>
#include <utility>

#include "ui/panels.h"

namespace lapwing::viewer {
namespace {

bool draw_slider(const char* label, double& value, double from, double to) {
  return ImGui::SliderScalar(label, ImGuiDataType_Double, &value, &from, &to, "%.3g");
}

// Uses a handle, because that is what the user can choose inside the ROI.
void draw_distance(DistanceRamp& ramp, const Editor& editor) {
  const auto& handles = editor.state().selection.handles;
  draw_slider("width##ramp", ramp.width, 0.0, 0.5 * editor.bounds().diagonal());
  if (handles.empty()) {
    ImGui::TextWrapped("Choose a handle (H) where the second source should appear.");
  } else if (ImGui::Button("take the handle's region")) {
    ramp.region = spec_of(handles[editor.handle()], "weight");
  }
}

void draw_painting(DetailTransferTool& desk, Editor& editor) {
  WeightPaint& paint = desk.weight_paint();
  bool paints = desk.is_painting();
  if (ImGui::Checkbox("paint it", &paints)) desk.paint_weight(paints, editor);
  draw_slider("weight", paint.strength, 0.0, 1.0);
  float radius = static_cast<float>(paint.brush().radius_pt);
  if (ImGui::SliderFloat("brush##weight", &radius, 1.0F, 200.0F, "%.0f points")) {
    paint.brush().radius_pt = static_cast<double>(radius);
  }
  if (ImGui::Button("Soften")) paint.soften(editor.state().rest->topology());
}

template <typename Form>
void draw_form(const char* label, DetailTransferTool& desk, Editor& editor) {
  auto& form = desk.draft().weight.form;
  if (!ImGui::RadioButton(label, std::holds_alternative<Form>(form))) return;
  if (std::holds_alternative<Form>(form)) return;
  form = Form{};
  desk.paint_weight(std::is_same_v<Form, PaintedWeight>, editor);
  // A ramp over the domain needs opposite sides, which only the square has.
  if (std::is_same_v<Form, DomainRamp>) desk.draft().parameters.domain = Domain::square;
}

}  // namespace

void draw_mix_weight(DetailTransferTool& desk, Editor& editor) {
  if (!ImGui::TreeNodeEx("Where the second source appears", ImGuiTreeNodeFlags_DefaultOpen)) return;
  draw_form<DomainRamp>("over the domain", desk, editor);
  draw_form<DistanceRamp>("around a part", desk, editor);
  draw_form<PaintedWeight>("painted", desk, editor);
  MixWeight& weight = desk.draft().weight;
  if (auto* ramp = std::get_if<DomainRamp>(&weight.form)) {
    draw_slider("from v", ramp->from, 0.0, 1.0);
    draw_slider("to v", ramp->to, 0.0, 1.0);
  } else if (auto* around = std::get_if<DistanceRamp>(&weight.form)) {
    draw_distance(*around, editor);
  } else {
    draw_painting(desk, editor);
  }
  using Profile = Transition::Profile;
  for (const auto& [label, profile] :
       {std::pair{"soft##mix", Profile::smooth}, std::pair{"linear##mix", Profile::linear}}) {
    if (ImGui::RadioButton(label, weight.profile == profile)) weight.profile = profile;
    ImGui::SameLine();
  }
  ImGui::NewLine();
  bool shape = desk.draft().transfer == TransferMode::shape;
  if (ImGui::Checkbox("the whole shapes, not only their detail", &shape)) {
    desk.draft().transfer = shape ? TransferMode::shape : TransferMode::coating;
  }
  ImGui::TreePop();
}

}  // namespace lapwing::viewer
