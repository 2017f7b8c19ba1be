// Draws the Coat and Mix tabs.

#include <imgui.h>
#include <utility>

#include "lapwing/recipe/step.h"
#include "state/whole_step.h"
#include "ui/panels.h"
#include "ui/parameter_panel.h"
#include "ui/widgets.h"

namespace lapwing::viewer {
namespace {

using Operation = LayerDraft::Operation;

void draw_slider(const char* label, double& value, double from, double to,
                 const char* format = "%.3g", ImGuiSliderFlags flags = ImGuiSliderFlags_None) {
  ImGui::SliderScalar(label, ImGuiDataType_Double, &value, &from, &to, format, flags);
}

const char* words(Operation operation) {
  return operation == Operation::coat
             ? "A coat puts the detail of a source patch on the ROI, which keeps its own shape."
             : "A mix puts the details of two source patches on the ROI, one passing into the "
               "other.";
}

// While nothing is open, draws what can be begun, and the steps that can be changed.
void draw_beginnings(DetailTransferTool& desk, Editor& editor, Operation operation) {
  const bool coats = operation == Operation::coat;
  ImGui::TextWrapped("%s", words(operation));
  if (ImGui::Button(coats ? "Begin a coat" : "Begin a mix")) desk.begin(editor, operation);
  explain(coats ? Action::begin_coat : Action::begin_mix);
  const auto& steps = editor.state().steps;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const auto draft = layer_draft_of(*steps[k]);
    if (!draft || draft->operation != operation) continue;
    ImGui::PushID(static_cast<int>(k));
    if (ImGui::SmallButton("change")) desk.take_up(editor, k);
    explain("Takes this step up again; those after it run again once it is applied.");
    ImGui::SameLine();
    ImGui::Text("%zu  %s", k + 1, describe(*steps[k]).c_str());
    ImGui::PopID();
  }
}

// Returns true if another file is to be chosen.
bool draw_source_file(DetailTransferTool& desk) {
  const std::size_t k = desk.current();
  const std::filesystem::path& mesh = desk.draft().sources[k].mesh;
  ImGui::Text("source: %s", mesh.empty() ? "this mesh" : mesh.filename().string().c_str());
  const bool asked = ImGui::Button("Another mesh...");
  if (!mesh.empty()) {
    ImGui::SameLine();
    if (ImGui::Button("This mesh")) desk.use_source(k, {});
  }
  return asked;
}

void draw_patch(DetailTransferTool& desk) {
  SourceView* view = desk.view();
  if (view == nullptr) {
    ImGui::TextDisabled("%s", desk.is_reading() ? "reading the source" : "no source");
    return;
  }
  if (view->patch().vertices.empty()) {
    ImGui::TextWrapped("Drag a disk over the source, beside the mesh, or take");
  } else {
    ImGui::Text("source patch: %zu vertices", view->patch().vertices.size());
  }
  if (ImGui::Button("the whole source")) desk.choose_source_patch({AllVertices{}});
  if (view->patch().vertices.empty()) return;
  ImGui::SameLine();
  if (ImGui::Button("the largest disk in it")) {
    desk.choose_source_patch({DiskInRegion{{spec_of(view->patch(), "source patch")}}});
  }
}

void draw_target(const DetailTransferTool& desk, const Editor& editor) {
  const std::size_t count = editor.state().selection.roi.vertices.size();
  if (desk.taken_up()) {
    ImGui::TextWrapped("You are changing step %zu; the steps after it run again.",
                       *desk.taken_up() + 1);
  } else if (count == 0) {
    ImGui::TextWrapped("Choose the target patch: it is the ROI (press I, then drag a disk).");
  } else {
    ImGui::Text("target patch: the ROI, %zu vertices", count);
  }
}

// Draws the sliders whose effect shows while they are dragged.
void draw_live_sliders(DetailTransferTool& desk) {
  CoatSource& source = desk.draft().sources[desk.current()];
  if (const SourceView* view = desk.view()) {
    const double size = view->shown().bounds().diagonal();
    draw_slider("detail size", source.detail_size, 1e-3 * size, 0.5 * size, "%.4g",
                ImGuiSliderFlags_Logarithmic);
  }
  draw_slider("amplitude", source.amplitude, -2.0, 2.0, "%.2f");
}

void draw_parameters(DetailTransferTool& desk, const Editor& editor) {
  if (!ImGui::TreeNode("How it is computed")) return;
  LayerDraft& draft = desk.draft();
  const double size = editor.bounds().diagonal();
  const bool had_transition = draft.parameters.transition.has_value();
  const Domain before = draft.parameters.domain;
  ParameterPanel panel(size);
  describe(draft.sources[desk.current()].sampling, panel);
  describe(draft.parameters, panel);
  if (draft.parameters.transition && !had_transition) {
    draft.parameters.transition->width = 0.05 * size;
  }
  if (draft.parameters.domain != before) {
    // Another domain has another number of boundary pairs.
    for (CoatSource& each : draft.sources) each.boundary_pairs.clear();
  }
  ImGui::TreePop();
}

void draw_pair_list(const char* where, std::vector<VertexPair>& pairs) {
  ImGui::PushID(where);
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    ImGui::PushID(static_cast<int>(p));
    const bool removed = ImGui::SmallButton("x");
    ImGui::SameLine();
    ImGui::Text("%s %zu: %u - %u", where, p + 1, pairs[p][0], pairs[p][1]);
    ImGui::PopID();
    if (!removed) continue;
    pairs.erase(pairs.begin() + static_cast<std::ptrdiff_t>(p));
    break;
  }
  ImGui::PopID();
}

void draw_pairs(DetailTransferTool& desk, Editor& editor) {
  using Picking = DetailTransferTool::Picking;
  if (!ImGui::TreeNodeEx("Corresponding points", ImGuiTreeNodeFlags_DefaultOpen)) return;
  CoatSource& source = desk.draft().sources[desk.current()];
  draw_pair_list("inside", source.inner_pairs);
  draw_pair_list("border", source.boundary_pairs);
  if (desk.picking() == Picking::none) {
    if (ImGui::Button("Pick inside")) desk.pick(Picking::inside, editor);
    ImGui::SameLine();
    if (ImGui::Button("Pick on the border")) desk.pick(Picking::border, editor);
  } else {
    ImGui::TextWrapped("%s", desk.picked_source()   ? "now the same place on the target"
                             : desk.picked_target() ? "now the same place on the source"
                                                    : "click the same place on both");
    if (ImGui::Button("Done picking")) desk.pick(Picking::none, editor);
  }
  ImGui::TreePop();
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

}  // namespace

std::optional<PathPurpose> draw_layer_panel(DetailTransferTool& desk, Editor& editor, Task task) {
  std::optional<PathPurpose> purpose;
  const Operation operation = task == Task::coat ? Operation::coat : Operation::mix;
  if (!desk.is_open() || desk.draft().operation != operation) {
    draw_beginnings(desk, editor, operation);
    return purpose;
  }
  ImGui::PushItemWidth(0.55F * ImGui::GetContentRegionAvail().x);
  draw_target(desk, editor);
  ImGui::Separator();
  if (desk.draft().source_count() == 2) {
    std::size_t current = desk.current();
    choose("source", current, {{"first", std::size_t{0}}, {"second", std::size_t{1}}});
    explain(Action::other_source);
    desk.show(current);
  }
  if (draw_source_file(desk)) purpose = PathPurpose::open_source;
  draw_patch(desk);
  draw_live_sliders(desk);
  draw_pairs(desk, editor);
  if (desk.draft().operation == Operation::mix) draw_mix_weight(desk, editor);
  draw_parameters(desk, editor);
  if (ImGui::TreeNode("Domain")) {
    draw_domain(desk.preview().layers(), desk.current());
    ImGui::TreePop();
  }
  ImGui::PopItemWidth();
  return purpose;
}

void draw_layer_result(DetailTransferTool& desk, Editor& editor) {
  const LayerPreview& preview = desk.preview();
  const WorkStatus step = editor.session().step_status();
  const WorkStatus work = step.busy ? step : preview.status();
  if (step.busy) {
    if (ImGui::Button("Stop")) editor.session().cancel_step();
  } else {
    if (ImGui::Button("Apply")) return desk.apply(editor);
    explain(Action::apply_step);
    ImGui::SameLine();
    if (ImGui::Button("Cancel")) return desk.close(editor);
    explain("Gives up what was not applied.");
  }
  ImGui::SameLine();
  bool previews = desk.previews();
  if (ImGui::Checkbox("live preview", &previews)) desk.set_previews(previews);
  explain("Computes the result while it is changed.");
  if (work.busy) {
    ImGui::ProgressBar(static_cast<float>(work.fraction), {-1.0F, 0.0F}, work.stage.c_str());
  }
  if (!preview.message().empty()) ImGui::TextWrapped("%s", preview.message().c_str());
  if (const LayeredCoat* layers = preview.layers()) {
    for (const std::string& warning : layers->warnings()) draw_colored(Tone::warning, warning);
  }
}

}  // namespace lapwing::viewer
