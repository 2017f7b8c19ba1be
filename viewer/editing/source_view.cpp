#include "editing/source_view.h"

#include <cmath>

#include "navigation/camera_motion.h"

namespace lapwing::viewer {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr Part kPatch{Part::Role::roi};

// As in the main view.
constexpr double kZoomPerNotch = 1.15;
constexpr double kZoomPt = 150.0;

}  // namespace

SourceView::SourceView(std::shared_ptr<const Mesh> mesh, UpAxis up_axis,
                       const std::shared_ptr<gpu::Context>& context)
    : state_(open_state(mesh)), up_axis_(up_axis), shown_(std::move(mesh)) {
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
  size_ = size;
  pixels_per_point_ = pixels_per_point;
  if (is_framed_) return;
  is_framed_ = true;
  camera_ = fit(surface_positions(shown_.positions(), surface_of(state_)->topology()),
                view_axes(View::three_quarter, up_axis_), size.x() / size.y());
}

ViewFrame SourceView::view_frame() const {
  ViewFrame view{camera_, size_, pixels_per_point_};
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
    point_ = picked->vertex;
    return ToolAnswer::only_taken();
  }
  const Projection projection = view.projection();
  return disk_.handle(event, {state_, shown_.positions(), projection, pick, {}, kPatch});
}

Editor::Handled SourceView::handle(const InputEvent& event, const Keymap& keymap) {
  if (!motion_) {
    const ToolAnswer answer = choose(event);
    if (answer.command) state_ = apply(std::move(state_), *answer.command);
    if (answer.taken) {
      classes_are_old_ = true;
      cursor_ = event.position;
      return {true, true};
    }
  }
  const bool was_moving = motion_.has_value();
  move_camera(event, keymap);
  return {true, was_moving || motion_ || event.kind == InputKind::scroll};
}

void SourceView::move_camera(const InputEvent& event, const Keymap& keymap) {
  switch (event.kind) {
    case InputKind::press:
      motion_ = motion_of(keymap, event.button, event.modifiers);
      cursor_ = pressed_at_ = event.position;
      if (motion_) orbit_center_ = focus(event.position);
      break;
    case InputKind::move:
      drag_to(event.position);
      break;
    case InputKind::release:
      drag_to(event.position);
      motion_.reset();
      break;
    case InputKind::scroll:
      focus(event.position);
      camera_ = zoomed(camera_, std::pow(kZoomPerNotch, event.scroll), event.position, size_,
                       zoom_range(shown_.bounds().diagonal()));
      break;
    case InputKind::key:
    case InputKind::text:
      break;
  }
}

Vector3d SourceView::focus(const Vector2d& pixel) {
  const auto point = shown_.pick(view_frame(), pixel);
  if (!point) return camera_.target;
  camera_ = focused(camera_, point->position);
  return point->position;
}

void SourceView::drag_to(const Vector2d& pixel) {
  const Vector2d moved = pixel - cursor_;
  cursor_ = pixel;
  if (!motion_) return;
  switch (*motion_) {
    case Motion::orbit:
      camera_ =
          orbited(camera_, moved, size_,
                  up_axis_ == UpAxis::y ? Vector3d::UnitY() : Vector3d::UnitZ(), orbit_center_);
      break;
    case Motion::pan:
      camera_ = panned(camera_, moved, size_);
      break;
    case Motion::zoom:
      camera_ = zoomed(camera_, std::exp((moved.x() - moved.y()) / (kZoomPt * pixels_per_point_)),
                       pressed_at_, size_, zoom_range(shown_.bounds().diagonal()));
      break;
  }
}

void SourceView::update() {
  if (!std::exchange(classes_are_old_, false) && !shown_.needs_classes()) return;
  shown_.set_classes(shown_classes(state_, kPatch, disk_.live(), false));
}

}  // namespace lapwing::viewer
