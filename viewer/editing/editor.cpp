#include "editing/editor.h"

#include <utility>

#include "editing/kernels_like.h"

namespace lapwing::viewer {
namespace {

// Returns the opened mesh with the triangles of the first state of the history.
std::shared_ptr<const Mesh> opened_surface(const History& history,
                                           const std::shared_ptr<const Mesh>& opened) {
  const AppState first =
      history.last_state([](const AppState& state) { return state.steps.empty(); });
  return surface_of(first.rest->shares_faces_with(*opened) ? first : open_state(opened));
}

}  // namespace

Editor::Editor(EditStart start, const std::shared_ptr<gpu::Context>& context, Say say,
               const std::function<void()>& wake)
    : say_(std::move(say)),
      session_(std::move(start.history), std::move(start.file), start.journals,
               kernels_like(context), wake, upload_to(context),
               start.restored ? &*start.restored : nullptr),
      active_(session_),
      view_(session_, active_, opened_surface(session_.history(), start.opened),
            {start.colors, start.opened}, say_, wake),
      drag_(session_, active_, view_),
      actions_(session_, active_, view_, drag_, say_,
               [this](bool by_result) { state_changed(by_result); }),
      input_(session_, active_, view_, drag_, actions_, say_) {
  if (!session_.warning().empty()) {
    say_({session_.warning(), Tone::warning});
  } else if (start.restored) {
    discard(*start.restored);
  }
  if (!state().selection.handles.empty()) {
    active_.choose({Part::Role::handle, 0});
    active_.take(Action::take_move);
  }
  view_.use_device(context);
  state_changed();
}

void Editor::release_device() {
  GizmoTool& gizmo = active_.tools().gizmo;
  const GizmoChoices choices = gizmo.choices();
  gizmo = {};
  gizmo.set_choices(choices);
  session_.cancel_preparation();
  view_.release_device();
}

void Editor::use_device(const std::shared_ptr<gpu::Context>& context) {
  session_.use_kernels(kernels_like(context), upload_to(context));
  view_.use_device(context);
  state_changed();
}

void Editor::update() {
  actions_.take_results();
  drag_.update();
  ShownSurface& shown = view_.shown();
  RulerTool& ruler = active_.tools().ruler;
  if (ruler.is_begun() && shown.has_triangles_of_state()) {
    ruler.follow(surface_of(state())->shared_topology(), shown.positions_on_screen(),
                 !shown.follows());
  }
  view_.update();
}

void Editor::state_changed(bool by_result) {
  active_.limit_to_handles();
  Tools& tools = active_.tools();
  // A result must not reset the tools while the user is already dragging or selecting.
  const bool goes_on = by_result && (active_.is_dragging() || actions_.has_postponed() ||
                                     !tools.loop.corners().empty());
  if (view_.take_state() && !goes_on) {
    tools.disk.reset();
    tools.loop.reset();
  }
  drag_.take_state();
  moves_as_a_whole_ = viewer::moves_as_a_whole(state());
  warnings_.clear();
  if (const Certificate* certificate = session_.certificate()) {
    warnings_ = warnings_of(*certificate, surface_of(state())->topology());
  }
}

}  // namespace lapwing::viewer
