#include "ui/viewer_app.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <imgui.h>

#include "lapwing/base/errors.h"
#include "lapwing/render/render_image.h"
#include "navigation/camera_motion.h"

namespace lapwing::viewer {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// A press and release within so many pixels is a click, not a drag.
constexpr double kClickPixels = 3.0;
constexpr double kZoomPerNotch = 1.15;
// Of a drag that zooms: pixels that make things e times as large.
constexpr double kZoomPixels = 150.0;
// Arrow keys turn by a twelfth of half a turn, 15 degrees.
constexpr double kOrbitShare = 1.0 / 12.0;
// Of what the mesh measures.
constexpr ZoomRange kZoomRange{1e-4, 1e2};
// Widths in letters of the font.
constexpr float kSidebarLetters = 20.0F;

bool is_click(const Vector2d& from, const Vector2d& to) {
  return (to - from).norm() <= kClickPixels;
}

}  // namespace

ViewerApp::ViewerApp(std::shared_ptr<gpu::Context> context)
    : context_(context),
      kernels_(std::in_place, context, Precision::automatic),
      loader_(context),
      id_picture_(std::in_place, *context),
      samples_(find_samples()) {}

void ViewerApp::use_device(std::shared_ptr<gpu::Context> context) {
  std::optional<LoadedFile> file;
  if (document_) file = std::move(document_->file);
  document_.reset();
  id_picture_.reset();
  loader_.use_device(context);
  kernels_.emplace(context, Precision::automatic);
  id_picture_.emplace(*context);
  context_ = std::move(context);
  if (file) document_.emplace(std::move(*file), *kernels_);
  say("the device was lost and opened again: " + context_->description().name);
}

void ViewerApp::open(const std::filesystem::path& file) {
  show_start_ = false;
  loader_.start(file);
}

void ViewerApp::take_loaded() {
  auto outcome = loader_.take();
  if (!outcome) return;
  try {
    if (outcome->error) std::rethrow_exception(outcome->error);
    if (outcome->file) show(std::move(*outcome->file));
  } catch (const Error& error) {
    if (order_) throw;
    say(error.what());
  }
  show_start_ = !document_;
}

void ViewerApp::show(LoadedFile file) {
  // Two meshes at a time may not fit on the device.
  document_.reset();
  document_.emplace(std::move(file), *kernels_);
  title_ = document_->file.name + " - Lapwing";
  up_axis_ = document_->file.up_axis;
  display_.style.color =
      document_->file.classes.empty() ? SurfaceColor::plain : SurfaceColor::regions;
  frames_shown_ = 0;
  show_start_ = false;
  look_from(View::three_quarter);
  frame_all();
  status_.clear();
  for (const std::string& note : document_->file.notes) say(note);
}

void ViewerApp::say(std::string message) {
  constexpr std::size_t kMostMessages = 200;
  if (log_.size() == kMostMessages) log_.erase(log_.begin());
  status_ = message.substr(0, message.find('\n'));
  log_.push_back(std::move(message));
}

void ViewerApp::resize(const Vector2d& size) {
  size_ = size;
  camera_.target_across = sidebar_share();
}

Vector3d ViewerApp::upward() const {
  return up_axis_ == UpAxis::y ? Vector3d::UnitY() : Vector3d::UnitZ();
}

double ViewerApp::sidebar_pixels() const {
  if (!show_panels_ || !document_) return 0.0;
  const ImGuiIO& io = ImGui::GetIO();
  const float font = ImGui::GetFont() != nullptr ? ImGui::GetFontSize() : 13.0F;
  const double per_unit = std::max(1.0F, io.DisplayFramebufferScale.x);
  return std::min(per_unit * static_cast<double>(kSidebarLetters * font), 0.5 * size_.x());
}

// How far right of the window's middle the free part's middle is, from 0 to 1.
double ViewerApp::sidebar_share() const {
  return sidebar_pixels() / size_.x();
}

void ViewerApp::frame_all() {
  if (!document_) return;
  Framing framing;
  framing.field_of_view = camera_.field_of_view;
  framing.orthographic = camera_.orthographic;
  framing.legend = sidebar_share();
  const Eigen::Matrix4d view = camera_.view();
  const ViewAxes axes{view.block<1, 3>(2, 0).transpose(), view.block<1, 3>(1, 0).transpose()};
  camera_ = fit(document_->file.mesh.positions, axes, size_.x() / size_.y(), framing);
  camera_.target_across = framing.legend;
}

void ViewerApp::look_from(View view) {
  camera_ = looking_from(camera_, view_axes(view, up_axis_));
}

void ViewerApp::orbit_by(double right, double down) {
  camera_ = orbited(camera_, {right, down}, size_, upward());
}

void ViewerApp::zoom_by(double factor, const Vector2d& cursor) {
  const double size = document_ ? std::max(document_->bounds.diagonal(), 1e-12) : 1.0;
  camera_ = zoomed(camera_, factor, cursor, size_,
                   {kZoomRange.nearest * size, kZoomRange.farthest * size});
}

void ViewerApp::drag_to(const InputEvent& event) {
  const Vector2d moved = event.position - cursor_;
  cursor_ = event.position;
  if (!motion_ || !document_) return;
  switch (*motion_) {
    case Motion::orbit:
      orbit_by(moved.x(), moved.y());
      break;
    case Motion::pan:
      camera_ = panned(camera_, moved, size_);
      break;
    case Motion::zoom:
      zoom_by(std::exp((moved.x() - moved.y()) / kZoomPixels), pressed_at_);
      break;
  }
}

bool ViewerApp::handle(const InputEvent& event) {
  switch (event.kind) {
    case InputKind::press:
      motion_ = motion_of(keymaps()[keymap_], event.button, event.modifiers);
      cursor_ = pressed_at_ = event.position;
      break;
    case InputKind::move:
      drag_to(event);
      return motion_.has_value();
    case InputKind::release:
      drag_to(event);
      motion_.reset();
      if (event.button == MouseButton::left && is_click(pressed_at_, event.position)) {
        say_what_is_at(event.position);
      }
      break;
    case InputKind::scroll:
      if (document_) zoom_by(std::pow(kZoomPerNotch, event.scroll), event.position);
      break;
    case InputKind::key:
    case InputKind::text:
      if (event.kind == InputKind::key && event.key == kEscape) {
        show_controls_ = false;
        picture_plan_.open = false;
        if (document_) show_start_ = false;
        loader_.cancel();
      }
      if (const auto action = action_of(event)) perform(*action);
      break;
  }
  return true;
}

void ViewerApp::perform(Action action) {
  const double step = kOrbitShare * size_.y();
  switch (action) {
    case Action::frame_all:
    case Action::frame_selection:
      return frame_all();
    case Action::view_front:
      return look_from(View::front);
    case Action::view_back:
      return look_from(View::back);
    case Action::view_right:
      return look_from(View::right);
    case Action::view_left:
      return look_from(View::left);
    case Action::view_top:
      return look_from(View::top);
    case Action::view_bottom:
      return look_from(View::bottom);
    case Action::view_three_quarter:
      return look_from(View::three_quarter);
    case Action::toggle_projection:
      camera_.orthographic = !camera_.orthographic;
      return;
    case Action::orbit_left:
      return orbit_by(step, 0.0);
    case Action::orbit_right:
      return orbit_by(-step, 0.0);
    case Action::orbit_up:
      return orbit_by(0.0, step);
    case Action::orbit_down:
      return orbit_by(0.0, -step);
    case Action::zoom_in:
      return zoom_by(kZoomPerNotch, 0.5 * size_);
    case Action::zoom_out:
      return zoom_by(1.0 / kZoomPerNotch, 0.5 * size_);
    case Action::toggle_wireframe:
      display_.style.wireframe = !display_.style.wireframe;
      return;
    case Action::toggle_flat:
      display_.style.flat = !display_.style.flat;
      return;
    case Action::toggle_panels:
      show_panels_ = !show_panels_;
      camera_.target_across = sidebar_share();
      return;
    case Action::toggle_controls:
      show_controls_ = !show_controls_;
      return;
    case Action::save_picture:
      picture_plan_.open = true;
      picture_plan_.width = static_cast<int>(size_.x());
      picture_plan_.height = static_cast<int>(size_.y());
      return;
    case Action::quit:
      quit_ = true;
      return;
  }
}

void ViewerApp::say_what_is_at(const Vector2d& pixel) {
  if (!document_ || pixel.x() < 0.0 || pixel.y() < 0.0) return;
  fit_depth(camera_, document_->bounds);
  const VkExtent2D size = window_size();
  id_picture_->draw(document_->surface, camera_, size.width, size.height);
  const auto pick = id_picture_->pick(document_->surface, static_cast<std::uint32_t>(pixel.x()),
                                      static_cast<std::uint32_t>(pixel.y()));
  if (!pick) {
    status_.clear();
    return;
  }
  char text[128];
  std::snprintf(text, sizeof text, "vertex %u, face %u at (%.5g, %.5g, %.5g)", pick->vertex,
                document_->file.topology.triangle_faces[pick->triangle], pick->position.x(),
                pick->position.y(), pick->position.z());
  status_ = text;
}

// Whether the eye is, give or take.
bool ViewerApp::is_inside(const Bounds& bounds) const {
  return (bounds.min.array() <= camera_.eye.array()).all() &&
         (camera_.eye.array() <= bounds.max.array()).all();
}

Scene ViewerApp::scene() {
  Scene scene;
  scene.background = display_.background;
  if (!document_) return scene;
  fit_depth(camera_, document_->bounds);
  scene.surface = &document_->surface;
  scene.paint = &document_->paint;
  scene.camera = camera_;
  scene.style = display_.style;
  scene.moving = motion_.has_value();
  if (scene.moving && document_->file.closed_outward && !is_inside(document_->bounds)) {
    scene.style.sides = Sides::front;
  }
  return scene;
}

VkExtent2D ViewerApp::window_size() const {
  return {static_cast<std::uint32_t>(size_.x()), static_cast<std::uint32_t>(size_.y())};
}

void ViewerApp::save_picture(const std::filesystem::path& path, VkExtent2D size) const {
  RenderOptions options;
  options.width = size.width;
  options.height = size.height;
  options.background = display_.background;
  options.style = display_.style;
  Camera camera = camera_;
  fit_depth(camera, document_->bounds);
  // Nothing covers a part of this picture.
  camera.target_across = 0.0;
  write_png(path, render_image(document_->surface, document_->paint, camera, options));
}

void ViewerApp::draw_picture_panel() {
  if (!picture_plan_.open || !document_ || !viewer::draw_picture_panel(picture_plan_)) return;
  try {
    save_picture(picture_plan_.path, {static_cast<std::uint32_t>(picture_plan_.width),
                                      static_cast<std::uint32_t>(picture_plan_.height)});
    say("saved " + picture_plan_.path);
  } catch (const Error& error) {
    say(error.what());
  }
}

void ViewerApp::carry_out_order() {
  // The first frame has been shown when the second one is laid out.
  if (!order_ || !document_ || frames_shown_ < 1) return;
  save_picture(order_->path, order_->size.value_or(window_size()));
  quit_ = true;
}

void ViewerApp::draw_ui(const FrameTimings& last) {
  take_loaded();
  carry_out_order();
  draw_menu();
  draw_status(last);
  if (show_panels_ && document_) draw_sidebar(last);
  if (show_start_ && !loader_.busy()) {
    if (const auto choice = draw_start_panel(samples_, typed_path_)) {
      if (const auto* path = std::get_if<std::filesystem::path>(&*choice)) {
        open(*path);
      } else {
        show(load_shape(*std::get<const NamedShape*>(*choice)));
      }
    }
  }
  draw_picture_panel();
  if (show_controls_) draw_controls_list(keymaps()[keymap_], show_controls_);
  if (document_) ++frames_shown_;
}

}  // namespace lapwing::viewer
