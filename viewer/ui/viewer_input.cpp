// Mouse and keys: the editor's tools come first, then the camera.

#include <algorithm>
#include <array>
#include <cmath>
#include <imgui.h>
#include <utility>

#include "editing/editor_actions.h"
#include "navigation/axis_gizmo.h"
#include "navigation/camera_motion.h"
#include "ui/viewer_app.h"

namespace lapwing::viewer {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// A press and release within so many points is a click, not a drag.
constexpr double kClickPt = 3.0;
// Points of a zooming drag that make things e times as large.
constexpr double kZoomPt = 150.0;
// Distance from the slider's line within which a press grabs it.
constexpr double kSliderPt = 5.0;
// Distance of the axis gizmo from the edges of the 3D view.
constexpr double kAxisGapPt = 6.0;
// Arrow keys turn by a twelfth of a half turn, 15 degrees.
constexpr double kOrbitShare = 1.0 / 12.0;
// Smallest free share of half the window's height.
constexpr double kLeastFree = 0.5;
// Room around a single framed vertex, in diagonals of the mesh.
constexpr double kSurroundings = 0.02;

constexpr auto kViews =
    std::to_array<std::pair<Action, View>>({{Action::view_front, View::front},
                                            {Action::view_back, View::back},
                                            {Action::view_right, View::right},
                                            {Action::view_left, View::left},
                                            {Action::view_top, View::top},
                                            {Action::view_bottom, View::bottom},
                                            {Action::view_three_quarter, View::three_quarter}});
constexpr auto kAskedPaths = std::to_array<std::pair<Action, PathPurpose>>(
    {{Action::open, PathPurpose::open},
     {Action::save_as, PathPurpose::save_mesh},
     {Action::save_recipe, PathPurpose::save_recipe},
     {Action::replay_recipe, PathPurpose::replay_recipe},
     {Action::carry_file, PathPurpose::carry_file}});

}  // namespace

void ViewerApp::resize(const Vector2d& size, double pixels_per_point) {
  size_ = size;
  pixels_per_point_ = pixels_per_point;
  preferences_.window_width = static_cast<int>(std::lround(size.x() / pixels_per_point));
  preferences_.window_height = static_cast<int>(std::lround(size.y() / pixels_per_point));
  camera_.target_across = covered_share();
}

bool ViewerApp::is_click(const Vector2d& from, const Vector2d& to) const {
  return (to - from).norm() <= kClickPt * pixels_per_point_;
}

Vector3d ViewerApp::upward() const {
  return up_axis_ == UpAxis::y ? Vector3d::UnitY() : Vector3d::UnitZ();
}

std::optional<PictureArea> ViewerApp::source_area() const {
  if (!document_ || !document_->desk.is_open() || document_->desk.view() == nullptr) return {};
  const double left = std::round(sidebar_pixels());
  const double width = std::floor(0.5 * (size_.x() - left));
  if (width < 1.0) return {};
  return PictureArea{{left, 0.0}, {width, size_.y()}};
}

// Returns the covered share of the window's width, which is also the offset of the free part's
// middle in half widths.
double ViewerApp::covered_share() const {
  const auto source = source_area();
  return (sidebar_pixels() + (source ? source->size.x() : 0.0)) / size_.x();
}

ViewFrame ViewerApp::view_frame() const {
  ViewFrame view{camera_, size_, pixels_per_point_};
  const Bounds bounds = document_->editor.bounds();
  const auto grid = shown_grid();
  fit_depth(view.camera, grid ? united(bounds, grid->bounds()) : bounds);
  return view;
}

GizmoKeys ViewerApp::gizmo_keys() const {
  return keymap().name == "Maya" ? GizmoKeys::maya : GizmoKeys::blender;
}

// Preferences of another version may name a keymap that does not exist here.
const Keymap& ViewerApp::keymap() const {
  for (const Keymap& each : keymaps()) {
    if (each.name == preferences_.mouse) return each;
  }
  return keymaps().front();
}

void ViewerApp::use_mouse_of(const std::string& keymap) {
  preferences_.mouse = keymap;
  if (document_) document_->editor.input().set_gizmo_keys(gizmo_keys());
}

void ViewerApp::frame_all() {
  if (!document_) return;
  const Editor& editor = document_->editor;
  Positions points =
      surface_positions(editor.view().positions(), surface_of(editor.state())->topology());
  document_->editor.view().carried().append_positions(points);
  frame_points(points);
}

void ViewerApp::frame(std::span<const Index> vertices) {
  if (!document_ || vertices.empty()) return;
  const Positions& positions = document_->editor.view().positions();
  Positions points;
  for (const Index v : vertices) points.push_back(positions[v]);
  // A single vertex is shown with what is around it.
  const double around = kSurroundings * document_->editor.bounds().diagonal();
  if (bounds_of(points).diagonal() < around) {
    const Vector3d middle = bounds_of(points).center();
    for (int axis = 0; axis < 3; ++axis) {
      points.push_back(middle + around * Vector3d::Unit(axis));
      points.push_back(middle - around * Vector3d::Unit(axis));
    }
  }
  frame_points(points);
}

void ViewerApp::frame_points(std::span<const Vector3d> points) {
  const Framing framing{.field_of_view = camera_.field_of_view,
                        .orthographic = camera_.orthographic,
                        .legend = covered_share()};
  camera_ = fit(points, axes_of(camera_), size_.x() / size_.y(), framing);
  camera_.target_across = framing.legend;
  if (!show_panels_) return;
  // Keep the points clear of menu and tools, too.
  const double half = 0.5 * size_.y();
  const double free = std::max(half - covered_top_ * pixels_per_unit(), kLeastFree * half);
  zoom_by(free / half, {0.5 * (1.0 + framing.legend) * size_.x(), half});
}

void ViewerApp::look_from(View view) {
  camera_ = looking_from(camera_, view_axes(view, up_axis_));
}

void ViewerApp::orbit_by(double right, double down, const Vector3d& center) {
  camera_ = orbited(camera_, {right, down}, size_, upward(), center);
}

Vector3d ViewerApp::focus(const Vector2d& pixel) {
  if (!document_) return camera_.target;
  const auto point = document_->editor.view().shown().pick(view_frame(), pixel);
  if (!point) return camera_.target;
  camera_ = focused(camera_, point->position);
  return point->position;
}

void ViewerApp::zoom_by(double factor, const Vector2d& cursor) {
  const double size = document_ ? document_->editor.bounds().diagonal() : 1.0;
  camera_ = zoomed(camera_, factor, cursor, size_, zoom_range(size));
}

void ViewerApp::drag_to(const InputEvent& event) {
  const Vector2d moved = event.position - cursor_;
  cursor_ = event.position;
  if (!motion_ || !document_) return;
  switch (*motion_) {
    case Motion::orbit:
      orbit_by(moved.x(), moved.y(), orbit_center_);
      break;
    case Motion::pan:
      camera_ = panned(camera_, moved, size_);
      break;
    case Motion::zoom:
      zoom_by(std::exp((moved.x() - moved.y()) / (kZoomPt * pixels_per_point_)), pressed_at_);
      break;
  }
}

// Whether a dialog waits for an answer. Then it gets the keys.
bool ViewerApp::asks() const {
  return leaving_for_ || overwriting_ || !interrupted_.empty() || chooser_.is_open() ||
         picture_plan_.open || turntable_plan_.picture.open || recording_;
}

// Whether a list or menu is open, which Escape closes before it reaches the tool.
bool ViewerApp::is_covered() const {
  return show_controls_ || (show_start_ && document_) ||
         ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
}

// Handles an event over the source, unless a drag that began elsewhere goes on there. Returns
// whether the picture changes; nullopt if the event is not the source's.
std::optional<bool> ViewerApp::handle_source(const InputEvent& event) {
  const auto area = source_area();
  const bool of_pointer = event.kind != InputKind::key && event.kind != InputKind::text;
  if (!area || !of_pointer || motion_ || document_->editor.tool().is_dragging()) return {};
  SourceView& view = *document_->desk.view();
  if (!view.holds_mouse() && !area->holds(event.position)) return {};
  InputEvent inside = event;
  inside.position -= area->corner;
  const bool changed = view.handle(inside, keymap()).changed;
  cursor_ = event.position;
  return changed || event.kind != InputKind::move;
}

std::optional<Vector2d> ViewerApp::axis_gizmo_center() const {
  if (!document_ || !show_panels_) return {};
  const PictureArea area = picture_area();
  const double gap = (kAxisGizmoPt + kAxisGapPt) * pixels_per_point_;
  const Vector2d corner =
      pixels_per_unit() * (area.corner + Vector2d(area.size.x(), banner_height_));
  return Vector2d(corner + Vector2d(-gap, gap));
}

bool ViewerApp::handle_axis_gizmo(const InputEvent& event) {
  const auto center = axis_gizmo_center();
  const bool presses = event.kind == InputKind::press;
  const bool is_left = event.button == MouseButton::left;
  if (presses) {
    on_axis_gizmo_ = center && is_left && !motion_ && !document_->editor.tool().is_dragging() &&
                     (event.position - *center).norm() <= kAxisGizmoPt * pixels_per_point_;
  }
  if (!on_axis_gizmo_ || !center || !is_left) return false;
  if (presses) {
    motion_ = Motion::orbit;
    orbit_center_ = camera_.target;
    cursor_ = pressed_at_ = event.position;
    return true;
  }
  if (event.kind != InputKind::release) return false;
  on_axis_gizmo_ = false;
  drag_to(event);
  motion_.reset();
  if (!is_click(pressed_at_, event.position)) return true;
  const Vector2d offset_pt = (event.position - *center) / pixels_per_point_;
  if (const auto end = axis_end_at(camera_, offset_pt)) look_from(view_from(*end, up_axis_));
  return true;
}

std::optional<double> ViewerApp::slider_line() const {
  if (!document_ || !slider_) return {};
  const double left = covered_share() * size_.x();
  return left + *slider_ * (size_.x() - left);
}

void ViewerApp::toggle_slider() {
  if (!document_) return;
  on_slider_ = false;
  if (std::exchange(slider_, slider_ ? std::nullopt : std::optional(0.5))) {
    document_->editor.view().shown().release_opened();
  } else {
    document_->editor.view().show_before(false);
  }
}

bool ViewerApp::handle_slider(const InputEvent& event) {
  const auto line = slider_line();
  const bool is_left = event.button == MouseButton::left;
  if (event.kind == InputKind::press) {
    on_slider_ = line && is_left && !motion_ && !document_->editor.tool().is_dragging() &&
                 std::abs(event.position.x() - *line) <= kSliderPt * pixels_per_point_;
  }
  if (!on_slider_ || !line || !is_of_pointer(event)) return false;
  const double left = covered_share() * size_.x();
  slider_ = std::clamp((event.position.x() - left) / std::max(size_.x() - left, 1.0), 0.0, 1.0);
  cursor_ = event.position;
  if (event.kind == InputKind::release && is_left) on_slider_ = false;
  return true;
}

bool ViewerApp::handle(const InputEvent& event) {
  if (event.kind != InputKind::move) messages_.acted(now());
  if (recording_) {
    // The scene must not change while it is being saved.
    if (event.kind == InputKind::key && event.key == kEscape) escape();
    return true;
  }
  if (asks() && (event.kind == InputKind::key || event.kind == InputKind::text)) {
    if (event.key == kEscape) {
      escape();
    } else if (!overwriting_) {
      chooser_.take(event);
    }
    return true;
  }
  if (event.kind == InputKind::key && event.key == kEscape && is_covered()) {
    escape();
    return true;
  }
  if (const auto changed = handle_source(event)) return *changed;
  if (handle_axis_gizmo(event) || handle_slider(event)) return true;
  Handled handled;
  if (document_ && !motion_) {
    handled = document_->editor.input().handle(event, view_frame());
    cursor_ = event.position;
    if (handled.taken) return true;
  }
  switch (event.kind) {
    case InputKind::press:
      motion_ = motion_of(keymap(), event.button, event.modifiers);
      cursor_ = pressed_at_ = event.position;
      if (motion_) orbit_center_ = focus(event.position);
      break;
    case InputKind::move:
      drag_to(event);
      return motion_.has_value() || handled.changed;
    case InputKind::release:
      drag_to(event);
      motion_.reset();
      if (document_ && event.button == MouseButton::left && is_click(pressed_at_, event.position)) {
        document_->editor.input().click(event.position, view_frame());
      }
      break;
    case InputKind::scroll:
      if (!document_) break;
      focus(event.position);
      zoom_by(std::pow(kZoomPerNotch, event.scroll), event.position);
      break;
    case InputKind::key:
    case InputKind::text:
      if (event.kind == InputKind::key && event.key == kEscape) {
        if (cancel_layers()) return true;
        escape();
      }
      if (const auto action = action_of(event)) perform(*action);
      break;
  }
  return true;
}

// Ends the picking or painting of a coat or mix, or else its step under way, or else the coat or
// mix. Returns false if there is none, or if something that Escape closes is open in front of it.
bool ViewerApp::cancel_layers() {
  const bool is_behind = view_before_ || show_machine_ || show_messages_ || loader_.status().busy;
  if (!document_ || !document_->desk.is_open() || is_behind) return false;
  document_->desk.cancel(document_->editor);
  return true;
}

void ViewerApp::escape() {
  if (recording_) return give_up_turntable("Cancelled");
  if (overwriting_) return answer_overwriting(false);
  if (view_before_) look_back();
  show_controls_ = false;
  show_machine_ = false;
  show_messages_ = false;
  picture_plan_.open = false;
  turntable_plan_.picture.open = false;
  // Close one thing at a time, so that what led to the chooser shows again.
  if (chooser_.is_open()) return chooser_.close();
  if (document_ && document_->mesh_steps.is_open()) {
    return document_->mesh_steps.close(document_->editor);
  }
  leaving_for_ = nullptr;
  interrupted_.clear();
  show_start_ = !document_;
  loader_.cancel();
}

void ViewerApp::perform(Action action) {
  if (document_ && perform_on(document_->editor, action)) return;
  if (document_ && perform_on(document_->desk, document_->editor, action)) return;
  for (const auto& [own, view] : kViews) {
    if (own == action) return look_from(view);
  }
  for (const auto& [own, purpose] : kAskedPaths) {
    if (own == action) return ask_for_path(purpose);
  }
  const double step = kOrbitShare * size_.y();
  switch (action) {
    case Action::frame_all:
      return frame_all();
    case Action::frame_selection:
      if (!document_) return;
      if (const auto vertices = document_->editor.tool().selected(); !vertices.empty()) {
        return frame(vertices);
      }
      return frame_all();
    case Action::toggle_projection:
      camera_.orthographic = !camera_.orthographic;
      return;
    case Action::orbit_left:
      return orbit_by(step, 0.0, camera_.target);
    case Action::orbit_right:
      return orbit_by(-step, 0.0, camera_.target);
    case Action::orbit_up:
      return orbit_by(0.0, step, camera_.target);
    case Action::orbit_down:
      return orbit_by(0.0, -step, camera_.target);
    case Action::zoom_in:
      return zoom_by(kZoomPerNotch, 0.5 * size_);
    case Action::zoom_out:
      return zoom_by(1.0 / kZoomPerNotch, 0.5 * size_);
    case Action::toggle_wireframe:
      display_.style.wireframe = !display_.style.wireframe;
      display_.style.xray = false;
      return;
    case Action::toggle_xray:
      display_.style.xray = !display_.style.xray;
      return;
    case Action::toggle_slider:
      return toggle_slider();
    case Action::toggle_flat:
      display_.style.flat = !display_.style.flat;
      return;
    case Action::toggle_panels:
      show_panels_ = !show_panels_;
      camera_.target_across = covered_share();
      return;
    case Action::toggle_controls:
      show_controls_ = !show_controls_;
      return;
    case Action::take_part:
      if (document_) document_->transplant.take_next_part();
      return;
    case Action::take_up_part:
      if (document_) document_->transplant.take_up_last(document_->editor);
      return;
    case Action::save:
      if (!document_) return;
      if (document_->save_path.empty()) return ask_for_path(PathPurpose::save_mesh);
      save_to(document_->save_path);
      return;
    case Action::open_source:
      if (document_ && document_->desk.is_open()) ask_for_path(PathPurpose::open_source);
      return;
    case Action::save_carried:
      if (document_) save_carried();
      return;
    case Action::save_picture:
      picture_plan_ = window_picture();
      return;
    case Action::save_turntable:
      turntable_plan_.picture = window_picture();
      return;
    case Action::quit:
      return ask_to_close();
    default:
      return;  // an action of the editor, but no mesh is open
  }
}

}  // namespace lapwing::viewer
