#include "editing/surface_view.h"

#include <utility>

namespace lapwing::viewer {

SurfaceView::SurfaceView(const EditSession& session, const ActiveTool& active,
                         std::shared_ptr<const Mesh> opened, FileColoring coloring, Say say,
                         std::function<void()> wake)
    : session_(session),
      active_(active),
      say_(std::move(say)),
      shown_(std::move(opened), std::move(coloring)),
      follower_(std::move(wake)) {
  shown_.take(session_.state());
}

void SurfaceView::release_device() {
  follower_.cancel();
  carried_.release_device();
  shown_.release_device();
}

void SurfaceView::use_device(const std::shared_ptr<gpu::Context>& context) {
  shown_.use_device(context);
  carried_.use_device(context);
}

bool SurfaceView::take_state() {
  const bool is_other = shown_.take(session_.state());
  classes_are_old_ = true;
  show_carried();
  return is_other;
}

void SurfaceView::update() {
  follow_carried();
  show_classes();
  if (!active_.tools().gizmo.is_dragging()) shown_.renew_measure();
}

void SurfaceView::show_before(bool before) {
  if (active_.is_dragging() || before == shown_.shows_before()) return;
  shown_.end_preview();
  shown_.show_before(before);
  take_state();
}

void SurfaceView::set_feature_angle(double degrees) {
  if (active_.is_dragging() || degrees == shown_.feature_angle()) return;
  shown_.end_preview();
  shown_.set_feature_angle(degrees);
  take_state();
}

void SurfaceView::show_carried() {
  using Where = ShownCarried::Where;
  follower_.cancel();
  carried_.take(session_.state(), shown_.shows_before()              ? Where::opened
                                  : needs_settling(session_.state()) ? Where::dragged
                                                                     : Where::still);
}

// Moves carried objects to the shown surface once their places are computed.
void SurfaceView::follow_carried() {
  const AppState& state = session_.state();
  if (!shown_.follows() || !any_follows(state.carried)) return;
  say_errors(say_, [&] {
    if (const auto places = follower_.take()) carried_.place(*places);
  });
  const Drag& drag = *shown_.device().drag_shown();
  follower_.follow(state, session_.preparation(),
                   {drag.response(), drag.pose(), shown_.followed()});
}

void SurfaceView::show_classes() {
  const SceneTool& tool = active_.scene_tool();
  const bool is_other_tool = std::exchange(classes_of_, &tool) != &tool;
  if (!std::exchange(classes_are_old_, false) && !is_other_tool && !shown_.needs_classes()) return;
  const AppState& state = session_.state();
  if (const StiffnessPaint& paint = active_.tools().stiffness; active_.is(paint)) {
    return shown_.set_classes(stiffness_classes(state, paint.live_stiffness(state)));
  }
  shown_.set_classes(
      shown_classes(state, active_.part(), tool.live(), tool.is_dragging() && tool.erases()));
}

}  // namespace lapwing::viewer
