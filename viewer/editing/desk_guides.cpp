#include "editing/desk_guides.h"

namespace lapwing::viewer {
namespace {

bool has_patch(const DetailTransferTool& desk, std::size_t k) {
  const auto* listed = std::get_if<ListedVertices>(&desk.draft().sources[k].patch.form);
  return listed == nullptr || !listed->vertices.empty();
}

const char* what_to_do(const DetailTransferTool& desk, const Editor& editor, bool has_target) {
  if (desk.picking() != DetailTransferTool::Picking::none) {
    return desk.picked_source()   ? "click the same place on the target; K ends picking"
           : desk.picked_target() ? "click the same place on the source; K ends picking"
                                  : "click the same place on source and target; K ends picking";
  }
  if (desk.is_painting())
    return "paint where the second source appears; Ctrl + wheel sizes the brush";
  if (!has_target && !desk.taken_up()) {
    return editor.part().role == Part::Role::roi && !editor.has_in_hand(editor.gizmo_tool())
               ? editor.hint()
               : "press I, then choose the region that gets the detail";
  }
  if (!has_patch(desk, desk.current())) {
    return "drag a disk over the source, beside the mesh; Ctrl+Shift+K takes another mesh";
  }
  if (desk.draft().source_count() == 2 && !has_patch(desk, 1 - desk.current())) {
    return "Shift+K shows the other source, which needs a patch, too";
  }
  return "Ctrl+Enter applies it; the sliders change it, K picks corresponding points";
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
  guide.what = what_to_do(desk, editor, has_target);
  return guide;
}

Guide guide_of_transplant(const TransplantDesk& desk, const Editor& editor) {
  using Stage = PlaceTool::Stage;
  const bool stands = desk.tool().stage() == Stage::set_down;
  Guide guide;
  guide.steps = {{{"Part", desk.has_part()}, {"Place", stands}, {"Apply", false}, {"", false}}};
  guide.current = stands ? 2 : desk.has_part() ? 1 : 0;
  guide.what = !desk.has_part()                   ? "the part is being read"
               : !editor.has_in_hand(desk.tool()) ? "another tool is in hand: \"Place by hand\" in "
                                                    "the Transplant panel takes the part again"
                                                  : editor.hint();
  return guide;
}

}  // namespace

Guide guide_of(const DetailTransferTool& layers, const TransplantDesk& transplant,
               const Editor& editor) {
  if (transplant.is_open()) return guide_of_transplant(transplant, editor);
  if (layers.is_open()) return guide_of_layers(layers, editor);
  const bool moves = editor.has_in_hand(editor.gizmo_tool());
  return guide_of(editor.state(), editor.part(), editor.tool(), moves);
}

}  // namespace lapwing::viewer
