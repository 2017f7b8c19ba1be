#include "ui/viewport.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <imgui.h>
#include <utility>

#include "navigation/axis_gizmo.h"
#include "navigation/camera_motion.h"
#include "ui/draw_axis_gizmo.h"

namespace lapwing::viewer {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Distance from the slider's line within which a press grabs it.
constexpr double kSliderPt = 5.0;
// Distance of the axis gizmo from the edges of the 3D view.
constexpr double kAxisGapPt = 6.0;
// Arrow keys rotate the view by 15 degrees.
constexpr double kOrbitShare = 1.0 / 12.0;
// Smallest free share of half the window's height.
constexpr double kLeastFree = 0.5;
// Room around a single framed vertex, in diagonals of the mesh.
constexpr double kSurroundings = 0.02;
// The view zooms out by this factor from the marked defects, because the banner covers a part of
// it.
constexpr double kRoomForBanner = 1.4;

constexpr auto kViews =
    std::to_array<std::pair<Action, View>>({{Action::view_front, View::front},
                                            {Action::view_back, View::back},
                                            {Action::view_right, View::right},
                                            {Action::view_left, View::left},
                                            {Action::view_top, View::top},
                                            {Action::view_bottom, View::bottom},
                                            {Action::view_three_quarter, View::three_quarter}});

struct Orbit {
  Action action;
  double right;
  double down;
};
constexpr std::array kOrbits{
    Orbit{Action::orbit_left, 1.0, 0.0}, Orbit{Action::orbit_right, -1.0, 0.0},
    Orbit{Action::orbit_up, 0.0, 1.0}, Orbit{Action::orbit_down, 0.0, -1.0}};

// Returns a camera that looks from `side`, rotated a little towards the previous view, so that the
// change of view is easy to follow.
Camera looking_at_side(const Camera& camera, const Vector3d& side, const Vector3d& up) {
  constexpr double kTowardsBefore = 0.4;
  constexpr double kParallel = 0.98;
  const ViewAxes before = axes_of(camera);
  const Vector3d toward_eye = (side + kTowardsBefore * before.toward_eye).normalized();
  // If the camera looks along the mesh's up axis, keep the up direction of the previous view.
  const bool along_up = std::abs(toward_eye.dot(up)) > kParallel;
  return looking_from(camera, {toward_eye, along_up ? before.up : up});
}

bool is_inside(const Vector3d& point, const Bounds& bounds) {
  return (bounds.min.array() <= point.array()).all() && (point.array() <= bounds.max.array()).all();
}

// Returns whether the bounds do not overlap or have very different sizes. A drag by a handle rarely
// moves a surface that far.
bool are_apart(const Bounds& a, const Bounds& b) {
  constexpr double kOtherSize = 10.0;
  const double ratio = a.diagonal() / b.diagonal();
  return (a.max.array() < b.min.array()).any() || (b.max.array() < a.min.array()).any() ||
         ratio > kOtherSize || ratio < 1.0 / kOtherSize;
}

}  // namespace

void Viewport::begin() {
  slider_.reset();
  view_before_.reset();
  surface_ = document_->editor.view().shown().surface_bounds();
  set_up_axis(document_->opened.up_axis);
  frame_all();
}

void Viewport::set_up_axis(UpAxis axis) {
  camera_.set_up_axis(axis);
  camera_.look_from(View::three_quarter);
}

void Viewport::resize(const Vector2d& size, double pixels_per_point) {
  camera_.resize(size, pixels_per_point);
  set_camera(camera_.camera());
}

void Viewport::update() {
  const auto area = source_area();
  if (area) document_->source()->resize(area->size, camera_.pixels_per_point());
  set_camera(camera_.camera());
  // The free part of the window has changed, or a wrap has moved the surface elsewhere.
  const Bounds before = std::exchange(surface_, document_->editor.view().shown().surface_bounds());
  const bool has_resized = std::exchange(shows_source_, area.has_value()) != area.has_value();
  if (has_resized || are_apart(before, surface_)) frame_all();
}

// The view is centred in the part of the window that is not covered.
void Viewport::set_camera(Camera camera) {
  camera.target_across = covered_share();
  camera_.set_camera(camera);
}

SurfaceStyle Viewport::style() const {
  SurfaceStyle style = style_of(display_, document_->editor);
  // The doctor marks defects in the colours of regions.
  if (document_->banner.marks()) style.color = SurfaceColor::regions;
  return style;
}

// The grid is placed under the mesh as it was opened, so that an edit does not move it.
std::optional<GroundGrid> Viewport::grid() const {
  if (!display_.grid) return {};
  return ground_grid(document_->editor.view().shown().opened_bounds(), camera_.up_axis());
}

ViewFrame Viewport::frame() const {
  ViewFrame view{camera_.camera(), camera_.size(), camera_.pixels_per_point()};
  const Bounds bounds = document_->editor.bounds();
  const auto shown_grid = grid();
  fit_depth(view.camera, shown_grid ? united(bounds, shown_grid->bounds()) : bounds);
  return view;
}

Scene Viewport::scene() {
  Scene scene;
  scene.background = display_.background;
  if (!document_) return scene;
  Editor& editor = document_->editor;
  SurfaceView& view = editor.view();
  scene.surface = &view.device().shown();
  scene.paint = &view.device().paint();
  scene.carried = view.carried().drawn();
  scene.camera = frame().camera;
  scene.grid = grid();
  scene.style = style();
  scene.style.pixels_per_point = static_cast<float>(camera_.pixels_per_point());
  scene.moving = camera_.is_moving() || on_slider_ || editor.tool().is_dragging();
  if (const auto line = slider_line()) {
    const EditSurface& opened = view.shown().opened_on_device();
    LeftScene& left = scene.left.emplace();
    left.surface = &opened.shown();
    left.paint = &opened.paint();
    left.style = scene.style;
    // The opened mesh has no measured values.
    if (left.style.color == SurfaceColor::scalar) left.style.color = SurfaceColor::regions;
    left.width = *line;
  }
  const bool closed = document_->closed_outward && view.shown().is_comparable();
  if (scene.moving && closed && !is_inside(camera_.camera().eye, editor.bounds())) {
    scene.style.sides = Sides::front;
  }
  if (const auto area = source_area()) {
    const SourceView& source = *document_->source();
    SideScene& beside = scene.beside.emplace();
    beside.surface = &source.shown().device().shown();
    beside.paint = &source.shown().device().paint();
    beside.camera = source.view_frame().camera;
    beside.style = display_.style;
    beside.style.color = SurfaceColor::regions;
    beside.style.pixels_per_point = scene.style.pixels_per_point;
    beside.corner = area->corner;
    beside.size = area->size;
    scene.moving = scene.moving || source.holds_mouse();
  }
  return scene;
}

void Viewport::draw_marks() {
  const double per_unit = pixels_per_unit();
  marks_.draw(document_->editor, frame(), per_unit, camera_.cursor());
  marks_.draw_transplant(document_->transplant, frame(), per_unit);
  if (const auto line = slider_line()) {
    marks_.draw_slider(frame(), per_unit, *line,
                       per_unit * (free_area().corner.y() + panels.banner));
  }
  if (const auto center = axis_gizmo_center()) {
    draw_axis_gizmo(camera_.camera(), *center / per_unit, camera_.pixels_per_point() / per_unit);
  }
  const auto area = source_area();
  if (!area) return;
  if (document_->wrap.is_open()) {
    marks_.draw(document_->wrap, document_->editor, frame(), area->corner, per_unit);
  } else {
    marks_.draw(document_->desk, document_->editor, frame(), area->corner, per_unit);
  }
  const auto [left, right] = document_->pane_names();
  marks_.draw_panes(left, right, free_area(), area->size.x() / per_unit);
}

double Viewport::pixels_per_unit() const {
  return std::max(1.0, camera_.size().x() / static_cast<double>(ImGui::GetMainViewport()->Size.x));
}

double Viewport::sidebar_width() const {
  return sidebar_pixels() / pixels_per_unit();
}

double Viewport::sidebar_pixels() const {
  if (!panels.are_shown || !document_) return 0.0;
  return std::min(pixels_per_unit() * panels.sidebar, kMostOfSidebar * camera_.size().x());
}

PictureArea Viewport::free_area() const {
  const ImGuiViewport& viewport = *ImGui::GetMainViewport();
  const Vector2d corner(sidebar_width() + static_cast<double>(viewport.WorkPos.x),
                        static_cast<double>(viewport.WorkPos.y) + panels.toolbar);
  const Vector2d end(
      static_cast<double>(viewport.WorkPos.x + viewport.WorkSize.x),
      static_cast<double>(viewport.WorkPos.y + viewport.WorkSize.y - status_height()));
  return {corner, (end - corner).cwiseMax(0.0)};
}

// Returns the rectangle of the window, in pixels, in which the source of an operation is shown.
std::optional<PictureArea> Viewport::source_area() const {
  if (!document_ || document_->source() == nullptr) return {};
  const double left = std::round(sidebar_pixels());
  const double width = std::floor(0.5 * (camera_.size().x() - left));
  if (width < 1.0) return {};
  return PictureArea{{left, 0.0}, {width, camera_.size().y()}};
}

// Returns the covered share of the window's width, which is also the offset of the free part's
// middle in half widths.
double Viewport::covered_share() const {
  const auto source = source_area();
  return (sidebar_pixels() + (source ? source->size.x() : 0.0)) / camera_.size().x();
}

CameraSubject Viewport::subject() {
  return {document_->editor.bounds().diagonal(), [this](const Vector2d& pixel) {
            return document_->editor.view().shown().place_at(frame(), pixel);
          }};
}

void Viewport::zoom_by(double factor, const Vector2d& cursor) {
  camera_.zoom_by(factor, cursor, document_ ? document_->editor.bounds().diagonal() : 1.0);
}

void Viewport::frame_all() {
  if (!document_) return;
  const Editor& editor = document_->editor;
  Positions points =
      surface_positions(editor.view().positions(), surface_of(editor.state())->topology());
  editor.view().carried().append_positions(points);
  frame_points(points);
}

void Viewport::frame_vertices(std::span<const Index> vertices) {
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

void Viewport::frame_points(std::span<const Vector3d> points) {
  const Camera& before = camera_.camera();
  const Vector2d size = camera_.size();
  const Framing framing{.field_of_view = before.field_of_view,
                        .orthographic = before.orthographic,
                        .legend = covered_share()};
  set_camera(fit(points, axes_of(before), size.x() / size.y(), framing));
  if (!panels.are_shown) return;
  // Keep the points clear of menu and tools, too.
  const double half = 0.5 * size.y();
  const double free = std::max(half - panels.covered_top * pixels_per_unit(), kLeastFree * half);
  zoom_by(free / half, {0.5 * (1.0 + framing.legend) * size.x(), half});
}

void Viewport::show_vertices(const std::vector<Index>& vertices) {
  if (!view_before_) view_before_ = camera_.camera();
  frame_vertices(vertices);
  document_->editor.view().point_at(vertices);
}

void Viewport::look_back() {
  set_camera(*std::exchange(view_before_, std::nullopt));
  if (document_) document_->editor.view().point_at({});
}

void Viewport::look_at_places() {
  const DoctorBanner& banner = document_->banner;
  camera_before_ = camera_.camera();
  if (banner.side()) {
    camera_.set_camera(looking_at_side(camera_.camera(), *banner.side(), camera_.upward()));
  }
  frame_vertices(banner.places());
  zoom_by(1.0 / kRoomForBanner, 0.5 * camera_.size());
}

void Viewport::look_back_from_places() {
  set_camera(camera_before_);
}

bool Viewport::perform(Action action) {
  for (const auto& [own, view] : kViews) {
    if (own != action) continue;
    camera_.look_from(view);
    return true;
  }
  Camera camera = camera_.camera();
  for (const auto& [own, right, down] : kOrbits) {
    if (own != action) continue;
    const double step = kOrbitShare * camera_.size().y();
    camera_.orbit_by({step * right, step * down}, camera.target);
    return true;
  }
  const Vector2d middle = 0.5 * camera_.size();
  switch (action) {
    case Action::frame_selection:
      if (!document_) return true;
      if (const auto vertices = document_->editor.tool().selected(); !vertices.empty()) {
        frame_vertices(vertices);
        return true;
      }
      [[fallthrough]];
    case Action::frame_all:
      frame_all();
      return true;
    case Action::toggle_projection:
      camera.orthographic = !camera.orthographic;
      camera_.set_camera(camera);
      return true;
    case Action::zoom_in:
      zoom_by(kZoomPerNotch, middle);
      return true;
    case Action::zoom_out:
      zoom_by(1.0 / kZoomPerNotch, middle);
      return true;
    case Action::toggle_slider:
      toggle_slider();
      return true;
    case Action::toggle_panels:
      panels.are_shown = !panels.are_shown;
      set_camera(camera);
      return true;
    default:
      return false;
  }
}

std::optional<bool> Viewport::handle(const InputEvent& event) {
  if (const auto changed = handle_source(event)) return changed;
  if (handle_axis_gizmo(event) || handle_slider(event)) return true;
  Handled handled;
  if (document_ && !camera_.is_moving()) {
    ToolInput& input = document_->editor.input();
    input.set_gizmo_keys(preferences_.mouse == "Maya" ? GizmoKeys::maya : GizmoKeys::blender);
    handled = input.handle(event, frame());
    camera_.set_cursor(event.position);
    if (handled.taken) return true;
  }
  if (!is_of_pointer(event)) return {};
  if (!document_) return event.kind != InputKind::move;
  camera_.handle(event, keymap_named(preferences_.mouse), subject());
  if (event.kind == InputKind::release && event.button == MouseButton::left &&
      camera_.is_click(event.position)) {
    document_->editor.input().click(event.position, frame());
  }
  return event.kind != InputKind::move || camera_.is_moving() || handled.changed;
}

// Handles an event over the source, unless a drag that began elsewhere is in progress. Returns
// whether the picture changes; nullopt if the event is not for the source.
std::optional<bool> Viewport::handle_source(const InputEvent& event) {
  const auto area = source_area();
  if (!area || !is_of_pointer(event) || camera_.is_moving() ||
      document_->editor.tool().is_dragging()) {
    return {};
  }
  SourceView& view = *document_->source();
  if (!view.holds_mouse() && !area->holds(event.position)) return {};
  InputEvent inside = event;
  inside.position -= area->corner;
  const bool changed = view.handle(inside, keymap_named(preferences_.mouse)).changed;
  camera_.set_cursor(event.position);
  return changed || event.kind != InputKind::move;
}

// Returns whether a press on the axis gizmo or the slider's line begins to drag it.
bool Viewport::may_begin(const InputEvent& event) const {
  return event.button == MouseButton::left && !camera_.is_moving() &&
         !document_->editor.tool().is_dragging();
}

// Returns the centre of the axis gizmo in pixels; nullopt if it is hidden.
std::optional<Vector2d> Viewport::axis_gizmo_center() const {
  if (!document_ || !panels.are_shown) return {};
  const PictureArea area = free_area();
  const double gap = (kAxisGizmoPt + kAxisGapPt) * camera_.pixels_per_point();
  const Vector2d corner =
      pixels_per_unit() * (area.corner + Vector2d(area.size.x(), panels.banner));
  return Vector2d(corner + Vector2d(-gap, gap));
}

// Handles a press or release on the axis gizmo. Returns whether the gizmo has taken the event.
bool Viewport::handle_axis_gizmo(const InputEvent& event) {
  const auto center = axis_gizmo_center();
  const bool presses = event.kind == InputKind::press;
  if (presses) {
    on_axis_gizmo_ = center && may_begin(event) &&
                     (event.position - *center).norm() <= kAxisGizmoPt * camera_.pixels_per_point();
  }
  if (!on_axis_gizmo_ || !center || event.button != MouseButton::left) return false;
  if (presses) {
    camera_.begin_orbit(event.position);
    return true;
  }
  if (event.kind != InputKind::release) return false;
  on_axis_gizmo_ = false;
  camera_.handle(event, keymap_named(preferences_.mouse), subject());
  if (!camera_.is_click(event.position)) return true;
  const Vector2d offset_pt = (event.position - *center) / camera_.pixels_per_point();
  if (const auto end = axis_end_at(camera_.camera(), offset_pt)) {
    camera_.look_from(view_from(*end, camera_.up_axis()));
  }
  return true;
}

// Returns the position of the slider's line, in pixels from the left; nullopt if the slider is off.
std::optional<double> Viewport::slider_line() const {
  if (!document_ || !slider_) return {};
  const double left = covered_share() * camera_.size().x();
  return left + *slider_ * (camera_.size().x() - left);
}

void Viewport::toggle_slider() {
  if (!document_) return;
  on_slider_ = false;
  if (std::exchange(slider_, slider_ ? std::nullopt : std::optional(0.5))) {
    document_->editor.view().shown().release_opened();
  } else {
    document_->editor.view().show_before(false);
  }
}

// Handles a drag of the slider's line. Returns whether the event belongs to such a drag.
bool Viewport::handle_slider(const InputEvent& event) {
  const auto line = slider_line();
  if (event.kind == InputKind::press) {
    on_slider_ = line && may_begin(event) &&
                 std::abs(event.position.x() - *line) <= kSliderPt * camera_.pixels_per_point();
  }
  if (!on_slider_ || !line || !is_of_pointer(event)) return false;
  const double left = covered_share() * camera_.size().x();
  const double width = std::max(camera_.size().x() - left, 1.0);
  slider_ = std::clamp((event.position.x() - left) / width, 0.0, 1.0);
  camera_.set_cursor(event.position);
  if (event.kind == InputKind::release && event.button == MouseButton::left) on_slider_ = false;
  return true;
}

}  // namespace lapwing::viewer
