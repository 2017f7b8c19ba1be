#include "editing/source_view.h"

namespace lapwing::viewer {
namespace {

using Eigen::Vector2d;

constexpr Part kPatch{Part::Role::roi};

}  // namespace

SourceView::SourceView(std::shared_ptr<const Mesh> mesh, UpAxis up_axis,
                       const std::shared_ptr<gpu::Context>& context)
    : state_(open_state(mesh)), shown_(std::move(mesh)) {
  camera_.set_up_axis(up_axis);
  // A coat takes the mesh as it is.
  state_.parameters.seams = SeamPolicy::leave;
  // A patch has no belt to show.
  state_.selection.belt_fraction = 0.0;
  shown_.take(state_);
  use_device(context);
}

void SourceView::use_device(const std::shared_ptr<gpu::Context>& context) {
  shown_.use_device(context);
  shown_.show_still();
  classes_are_old_ = true;
}

void SourceView::choose_patch(const RegionSpec& region) {
  state_ = apply(std::move(state_), Choose{kPatch, region});
  classes_are_old_ = true;
}

void SourceView::resize(const Vector2d& size, double pixels_per_point) {
  camera_.resize(size, pixels_per_point);
  if (is_framed_) return;
  is_framed_ = true;
  camera_.set_camera(fit(surface_positions(shown_.positions(), surface_of(state_)->topology()),
                         view_axes(View::three_quarter, camera_.up_axis()), size.x() / size.y()));
}

ViewFrame SourceView::view_frame() const {
  ViewFrame view{camera_.camera(), camera_.size(), camera_.pixels_per_point()};
  fit_depth(view.camera, shown_.bounds());
  return view;
}

ToolAnswer SourceView::choose(const InputEvent& event) {
  if (event.kind == InputKind::press && event.modifiers.alt) return ToolAnswer::passed_on();
  const ViewFrame view = view_frame();
  const auto pick = [this, &view](const Vector2d& pixel) { return shown_.pick(view, pixel); };
  if (tool_ == SourceTool::point) {
    if (event.kind != InputKind::press || event.button != MouseButton::left) return {};
    const auto picked = pick(event.position);
    if (!picked) return ToolAnswer::passed_on();
    point_ = picked;
    return ToolAnswer::only_taken();
  }
  const Projection projection = view.projection();
  return disk_.handle(event, {state_, shown_.positions(), projection, pick, {}, kPatch});
}

Handled SourceView::handle(const InputEvent& event, const Keymap& keymap) {
  const bool was_moving = camera_.is_moving();
  if (!was_moving) {
    const ToolAnswer answer = choose(event);
    if (answer.command) state_ = apply(std::move(state_), *answer.command);
    if (answer.taken) {
      classes_are_old_ = true;
      camera_.set_cursor(event.position);
      return {true, true};
    }
  }
  const auto pick = [this](const Vector2d& pixel) { return shown_.place_at(view_frame(), pixel); };
  camera_.handle(event, keymap, {shown_.bounds().diagonal(), pick});
  return {true, was_moving || camera_.is_moving() || event.kind == InputKind::scroll};
}

void SourceView::update() {
  if (!std::exchange(classes_are_old_, false) && !shown_.needs_classes()) return;
  shown_.set_classes(shown_classes(state_, kPatch, disk_.live(), false));
}

}  // namespace lapwing::viewer
