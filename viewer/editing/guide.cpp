#include "editing/guide.h"

namespace lapwing::viewer {
namespace {

bool has_patch(const DetailTransferTool& desk, std::size_t k) {
  return is_chosen(desk.draft().sources[k].patch);
}

const char* what_to_do(const DetailTransferTool& desk, const Editor& editor, bool has_target) {
  if (desk.picking() != DetailTransferTool::Picking::none) {
    return desk.picked_source() ? "Click the same place on the target. K ends picking."
           : desk.picked_target()
               ? "Click the same place on the source. K ends picking."
               : "Click the same place on the source and on the target. K ends picking.";
  }
  if (desk.is_painting())
    return "Paint where the second source should appear. Ctrl+wheel resizes the brush.";
  if (!has_target && !desk.taken_up()) {
    return editor.tool().part().role == Part::Role::roi && editor.tool().chooses_parts()
               ? editor.input().hint()
               : "Press I, then select the region that gets the detail.";
  }
  if (!has_patch(desk, desk.current())) {
    return "Drag a disk on the source shown beside the mesh. Ctrl+Shift+K opens another mesh.";
  }
  if (desk.draft().source_count() == 2 && !has_patch(desk, 1 - desk.current())) {
    return "Press Shift+K, then drag a disk on the other source.";
  }
  return "Adjust the sliders, or press K to pick corresponding points. Ctrl+Enter applies, Escape "
         "cancels.";
}

Guide guide_of_layers(const DetailTransferTool& desk, const Editor& editor) {
  const bool has_target = !editor.state().selection.roi.vertices.empty() || desk.taken_up();
  Guide guide;
  guide.count = 0;
  const auto add = [&guide](const char* name, bool is_done) {
    if (is_done && guide.current == guide.count) ++guide.current;
    guide.steps[guide.count++] = {name, is_done};
  };
  add("Target", has_target);
  if (desk.draft().source_count() == 1) {
    add("Source", has_patch(desk, 0));
  } else {
    add("First source", has_patch(desk, 0));
    add("Second source", has_patch(desk, 1));
  }
  add("Apply", false);
  // The words are about the source that is shown.
  const bool is_other = desk.draft().source_count() == 2 && !has_patch(desk, desk.current());
  if (has_target && is_other) guide.current = 1 + desk.current();
  guide.what = what_to_do(desk, editor, has_target);
  return guide;
}

Guide guide_of_transplant(const TransplantTool& desk, const Editor& editor) {
  using Stage = PlaceTool::Stage;
  const bool stands = desk.tool().stage() == Stage::set_down;
  Guide guide;
  guide.steps = {{{"Part", desk.has_part()}, {"Place", stands}, {"Apply", false}, {"", false}}};
  const bool is_in_hand = editor.tool().is(desk.tool());
  guide.current = stands && is_in_hand ? 2 : desk.has_part() ? 1 : 0;
  guide.what = !desk.has_part() ? "Reading the part."
               : !is_in_hand
                   ? "Click \"Place by hand\" in the Transplant tab to continue placing the part."
                   : editor.input().hint();
  return guide;
}

Guide guide_of_wrap(const WrapTool& wrap, const Editor& editor) {
  constexpr std::size_t kEnough = 3;
  const bool has_scan = wrap.view() != nullptr;
  const bool has_result = wrap.report() != nullptr && wrap.is_current(editor);
  const bool has_pairs = has_result || wrap.landmarks().size() >= kEnough;
  Guide guide;
  guide.count = 4;
  guide.steps = {
      {{"Scan", has_scan}, {"Landmarks", has_pairs}, {"Wrap", has_result}, {"Apply", false}}};
  guide.current = has_result ? 3 : has_pairs ? 2 : has_scan ? 1 : 0;
  guide.what =
      !has_scan                      ? "Reading the scan."
      : wrap.preview().status().busy ? "Wrapping. Escape stops it."
      : wrap.moved() ? "Click the new position of the point, on the template or on the scan."
      : wrap.picked_on_scan()     ? "Click the same place on the template. K ends picking."
      : wrap.picked_on_template() ? "Click the same place on the scan. K ends picking."
      : has_result                ? "Look at the distances. Apply the result, or add landmarks and "
                                    "wrap again."
      : !wrap.picks()             ? "Press K to pick landmarks, or click \"Wrap\"."
      : has_pairs
          ? "Click \"Wrap\", or click more points: a place on the scan, then on the template."
          : "Click a place on the scan and the same place on the template. Three pairs "
            "align them.";
  return guide;
}

}  // namespace

Guide guide_of(const AppState& state, const Part& part, const SceneTool& tool, bool moves) {
  const bool has_roi = !state.selection.roi.vertices.empty();
  const bool has_handle = !state.selection.handles.empty();
  Guide guide;
  guide.steps = {{{"Region", has_roi}, {"Handle", has_handle}, {"Move", is_moved(state)}, {}}};
  const bool can_move = moves && has_roi && has_handle;
  // The step that the words below are about. No step selects the fixed border.
  const bool selects_handle = moves ? has_roi : part.role == Part::Role::handle;
  guide.current = can_move                                  ? 2
                  : selects_handle                          ? 1
                  : !moves && part.role == Part::Role::belt ? guide.count
                                                            : 0;
  guide.what = tool.hint(state, part);
  if (can_move && is_moved(state))
    guide.what = "Drag the gizmo to continue. Ctrl+N begins another edit.";
  return guide;
}

Guide guide_of(const DetailTransferTool& layers, const TransplantTool& transplant,
               const WrapTool& wrap, const Editor& editor) {
  if (wrap.is_open()) return guide_of_wrap(wrap, editor);
  if (transplant.is_open()) return guide_of_transplant(transplant, editor);
  if (layers.is_open()) return guide_of_layers(layers, editor);
  // These tools take no part in the steps.
  const Action tool =
      editor.tool().row() != nullptr ? editor.tool().row()->action : Action::take_move;
  if (tool == Action::take_grab || tool == Action::take_ruler || tool == Action::take_stiffness ||
      editor.input().picks_pivot()) {
    return {.count = 0, .what = editor.input().hint()};
  }
  const bool moves = editor.tool().is(editor.tool().tools().gizmo);
  // A pin is a handle, whichever part was chosen before.
  const Part part = tool == Action::take_pin ? Part{Part::Role::handle} : editor.tool().part();
  return guide_of(editor.state(), part, editor.tool().scene_tool(), moves);
}

}  // namespace lapwing::viewer
