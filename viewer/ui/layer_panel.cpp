// Draws the Coat and Mix tabs.

#include <cmath>
#include <imgui.h>
#include <utility>

#include "lapwing/recipe/step.h"
#include "state/whole_step.h"
#include "ui/panels.h"
#include "ui/parameter_panel.h"
#include "ui/widgets.h"
#include "work/window_words.h"

namespace lapwing::viewer {
namespace {

using Operation = LayerDraft::Operation;

void draw_slider(const char* label, double& value, double from, double to,
                 const char* format = "%.3g", ImGuiSliderFlags flags = ImGuiSliderFlags_None) {
  label_field(label);
  ImGui::PushID(label);
  ImGui::SliderScalar("##slider", ImGuiDataType_Double, &value, &from, &to, format, flags);
  ImGui::PopID();
}

const char* words(Operation operation) {
  return operation == Operation::coat
             ? "Puts the detail of a source patch on the region. The region keeps its overall "
               "shape."
             : "Puts the detail of two source patches on the region. One blends into the other.";
}

// While nothing is open, draws what can be begun, and the steps that can be changed.
void draw_beginnings(DetailTransferTool& desk, Editor& editor, Operation operation) {
  const bool coats = operation == Operation::coat;
  ImGui::TextWrapped("%s", words(operation));
  if (ImGui::Button(coats ? "New coat" : "New mix")) desk.begin(editor, operation);
  explain(coats ? Action::begin_coat : Action::begin_mix);
  const auto& steps = editor.state().steps;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const auto draft = layer_draft_of(*steps[k]);
    if (!draft || draft->operation != operation) continue;
    ImGui::PushID(static_cast<int>(k));
    if (ImGui::SmallButton("Edit")) desk.take_up(editor, k);
    explain("Edits this step again. When you apply it, the steps after it run again.");
    ImGui::SameLine();
    ImGui::Text("%zu  %s", k + 1, describe(*steps[k]).c_str());
    ImGui::PopID();
  }
}

// Returns true if another file is to be chosen.
bool draw_source_file(DetailTransferTool& desk) {
  const std::size_t k = desk.current();
  const std::filesystem::path& mesh = desk.draft().sources[k].mesh;
  ImGui::Text("Source: %s", mesh.empty() ? "this mesh" : mesh.filename().string().c_str());
  const bool asked = ImGui::Button("Open another mesh...");
  if (!mesh.empty()) {
    ImGui::SameLine();
    if (ImGui::Button("Use this mesh")) desk.use_source(k, {});
  }
  return asked;
}

void draw_patch(DetailTransferTool& desk) {
  SourceView* view = desk.view();
  if (view == nullptr) {
    ImGui::TextDisabled("%s", desk.is_reading() ? "Reading the source..." : "No source");
    return;
  }
  if (view->patch().vertices.empty()) {
    ImGui::TextWrapped(
        "%s", desk.lies_on_target()
                  ? "The part of the source that lies on the region is used."
                  : "Drag a disk on the source shown beside the mesh, or use the whole source.");
  } else {
    ImGui::Text("Source patch: %zu vertices", view->patch().vertices.size());
  }
  if (ImGui::Button("Use whole source")) desk.choose_source_patch({AllVertices{}});
  if (view->patch().vertices.empty()) return;
  ImGui::SameLine();
  if (ImGui::Button("Use largest disk")) {
    desk.choose_source_patch({DiskInRegion{{spec_of(view->patch(), "source patch")}}});
  }
}

void draw_target(const DetailTransferTool& desk, const Editor& editor) {
  const std::size_t count = editor.state().selection.roi.vertices.size();
  if (desk.taken_up()) {
    ImGui::TextWrapped("Editing step %zu. The steps after it run again when you apply it.",
                       *desk.taken_up() + 1);
  } else if (count == 0) {
    ImGui::TextWrapped("Target: select a region (press I, then drag a disk).");
  } else {
    ImGui::Text("Target: the region, %zu vertices", count);
  }
}

// Draws the sliders whose effect shows while they are dragged.
void draw_live_sliders(DetailTransferTool& desk, const std::string& unit) {
  CoatSource& source = desk.draft().sources[desk.current()];
  if (const SourceView* view = desk.view()) {
    const double size = view->shown().bounds().diagonal();
    const std::string format = with_unit("%.4g", unit);
    draw_slider("Detail size", source.detail_size, 1e-3 * size, 0.5 * size, format.c_str(),
                ImGuiSliderFlags_Logarithmic);
  }
  draw_slider("Amplitude", source.amplitude, -2.0, 2.0, "%.2f");
}

void draw_parameters(DetailTransferTool& desk, const Editor& editor) {
  if (!ImGui::TreeNode("Solver settings")) return;
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
    const bool removed = ImGui::SmallButton("Delete");
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
  draw_pair_list("Inside", source.inner_pairs);
  draw_pair_list("Border", source.boundary_pairs);
  if (desk.picking() == Picking::none) {
    if (ImGui::Button("Pick inside")) desk.pick(Picking::inside, editor);
    ImGui::SameLine();
    if (ImGui::Button("Pick on border")) desk.pick(Picking::border, editor);
  } else {
    ImGui::TextWrapped("%s", desk.picked_source() ? "Click the same place on the target."
                             : desk.picked_target()
                                 ? "Click the same place on the source."
                                 : "Click the same place on the source and on the target.");
    if (ImGui::Button("Stop picking")) desk.pick(Picking::none, editor);
  }
  ImGui::TreePop();
}

// Uses a handle, because that is what the user can choose inside the ROI.
void draw_distance(DistanceRamp& ramp, const Editor& editor) {
  const auto& handles = editor.state().selection.handles;
  draw_slider("Width", ramp.width, 0.0, 0.5 * editor.bounds().diagonal());
  if (handles.empty()) {
    ImGui::TextWrapped("Select a handle (H) where the second source should appear.");
  } else if (ImGui::Button("Use handle")) {
    ramp.region = spec_of(handles[editor.tool().handle()], "weight");
  }
}

void draw_painting(DetailTransferTool& desk, Editor& editor) {
  WeightPaint& paint = desk.weight_paint();
  bool paints = desk.is_painting();
  if (ImGui::Checkbox("Paint", &paints)) desk.paint_weight(paints, editor);
  draw_slider("Weight", paint.strength, 0.0, 1.0);
  float radius = static_cast<float>(paint.brush().radius_pt);
  label_field("Brush radius");
  if (ImGui::SliderFloat("##brush", &radius, 1.0F, 200.0F, "%.0f pt")) {
    paint.brush().radius_pt = static_cast<double>(radius);
  }
  if (ImGui::Button("Smooth")) paint.soften(editor.state().rest->topology());
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
  draw_form<DomainRamp>("Across the domain", desk, editor);
  draw_form<DistanceRamp>("Around a handle", desk, editor);
  draw_form<PaintedWeight>("Painted", desk, editor);
  MixWeight& weight = desk.draft().weight;
  if (auto* ramp = std::get_if<DomainRamp>(&weight.form)) {
    draw_slider("Start", ramp->from, 0.0, 1.0);
    draw_slider("End", ramp->to, 0.0, 1.0);
  } else if (auto* around = std::get_if<DistanceRamp>(&weight.form)) {
    draw_distance(*around, editor);
  } else {
    draw_painting(desk, editor);
  }
  using Profile = Transition::Profile;
  for (const auto& [label, profile] :
       {std::pair{"Smooth##mix", Profile::smooth}, std::pair{"Linear##mix", Profile::linear}}) {
    if (ImGui::RadioButton(label, weight.profile == profile)) weight.profile = profile;
    ImGui::SameLine();
  }
  ImGui::NewLine();
  bool shape = desk.draft().transfer == TransferMode::shape;
  if (ImGui::Checkbox("Mix whole shapes, not only detail", &shape)) {
    desk.draft().transfer = shape ? TransferMode::shape : TransferMode::coating;
  }
  ImGui::TreePop();
}

// Calls `visit` with each source that the warning is about.
void visit_sources(const Warning& warning, LayerDraft& draft, const auto& visit) {
  for (std::size_t k = 0; k < draft.source_count(); ++k) {
    if (!warning.source || *warning.source == k) visit(draft.sources[k]);
  }
}

// Returns whether the user has followed the advice with a slider. Sliders do not renew warnings.
bool is_followed(const Warning& warning, LayerDraft& draft) {
  if (warning.advice != Advice::negate_amplitude) return false;
  bool is_negative = true;
  visit_sources(warning, draft, [&](const CoatSource& source) {
    is_negative = is_negative && source.amplitude < 0.0;
  });
  return is_negative;
}

void follow_advice(const Warning& warning, DetailTransferTool& desk, Editor& editor) {
  LayerDraft& draft = desk.draft();
  if (warning.advice == Advice::set_transition_width) {
    if (!draft.parameters.transition) draft.parameters.transition.emplace();
    draft.parameters.transition->width = warning.value;
  } else if (warning.advice == Advice::set_scale) {
    visit_sources(warning, draft,
                  [&](CoatSource& source) { source.sampling.scale = warning.value; });
  } else if (warning.advice == Advice::negate_amplitude) {
    visit_sources(warning, draft,
                  [](CoatSource& source) { source.amplitude = -std::abs(source.amplitude); });
  } else if (warning.advice == Advice::refine_target) {
    const RemeshRequest finer{.region = draft.target_patch, .scale = 0.5};
    desk.close(editor);
    editor.actions().carry_out(finer);
  }
}

}  // namespace

std::optional<PathPurpose> draw_layer_panel(DetailTransferTool& desk, Editor& editor, Task task,
                                            const std::string& unit) {
  std::optional<PathPurpose> purpose;
  const Operation operation = task == Task::coat ? Operation::coat : Operation::mix;
  if (!desk.is_open() || desk.draft().operation != operation) {
    draw_beginnings(desk, editor, operation);
    return purpose;
  }
  draw_target(desk, editor);
  ImGui::Separator();
  if (desk.draft().source_count() == 2) {
    std::size_t current = desk.current();
    choose("Source", current, {{"First", std::size_t{0}}, {"Second", std::size_t{1}}});
    explain(Action::other_source);
    desk.show(current);
  }
  if (draw_source_file(desk)) purpose = PathPurpose::open_source;
  draw_patch(desk);
  draw_live_sliders(desk, unit);
  draw_pairs(desk, editor);
  if (desk.draft().operation == Operation::mix) draw_mix_weight(desk, editor);
  draw_parameters(desk, editor);
  if (ImGui::TreeNode("Domain")) {
    draw_domain(desk.preview().layers(), desk.current());
    ImGui::TreePop();
  }
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
    explain("Discards the coat or mix.", "Shortcut: Escape");
  }
  ImGui::SameLine();
  bool previews = desk.previews();
  if (ImGui::Checkbox("Live preview", &previews)) desk.set_previews(previews);
  explain("Updates the result while you change the settings.");
  if (work.busy) {
    ImGui::ProgressBar(static_cast<float>(work.fraction), {-1.0F, 0.0F},
                       stage_in_words(work.stage).data());
  }
  if (!preview.message().empty())
    ImGui::TextWrapped("%s", in_window_words(preview.message()).c_str());
  if (const LayeredCoat* layers = preview.layers()) {
    const std::vector<Warning> warnings = layers->warnings();
    for (const Warning& warning : warnings) {
      if (!is_followed(warning, desk.draft()) && draw_engine_warning(warning)) {
        return follow_advice(warning, desk, editor);
      }
    }
  }
}

}  // namespace lapwing::viewer
