// Opens the dialogs, carries out what the user chooses in them, and draws the mesh doctor's banner.

#include <cmath>
#include <utility>

#include "navigation/camera_motion.h"
#include "ui/viewer_app.h"

namespace lapwing::viewer {
namespace {

// The view zooms out by this factor from the marked defects, because the banner covers a part of
// it.
constexpr double kRoomForBanner = 1.4;

// Returns a camera that looks from `side`, turned a little towards the view before, so that the
// user sees where it is.
Camera looking_at_side(const Camera& camera, const Eigen::Vector3d& side,
                       const Eigen::Vector3d& up) {
  constexpr double kTowardsBefore = 0.4;
  constexpr double kParallel = 0.98;
  const ViewAxes before = axes_of(camera);
  const Eigen::Vector3d toward_eye = (side + kTowardsBefore * before.toward_eye).normalized();
  // If the view goes along the mesh's up axis, keep what is up on the screen.
  const bool along_up = std::abs(toward_eye.dot(up)) > kParallel;
  return looking_from(camera, {toward_eye, along_up ? before.up : up});
}

}  // namespace

void ViewerApp::draw_dialogs() {
  if (!interrupted_.empty()) {
    draw_interrupted();
  } else if (show_start_ && !chooser_.is_open() && !loader_.status().busy) {
    draw_start();
  }
  if (overwriting_) {
    // Before the dialogs that lead to it, because a key pressed there is no answer here.
    if (const auto writes = draw_overwrite_panel(overwriting_->file)) answer_overwriting(*writes);
  } else {
    const auto plans = [this](const PicturePlan& plan) {
      return plan.open && document_ && !chooser_.is_open();
    };
    if (plans(picture_plan_) && draw_picture_panel(picture_plan_)) {
      ask_for_path(PathPurpose::save_picture);
    }
    if (plans(turntable_plan_.picture) && draw_turntable_panel(turntable_plan_)) {
      ask_for_path(PathPurpose::save_turntable);
    }
    if (const auto chosen = chooser_.draw()) use_path(*chosen);
    if (leaving_for_ && !chooser_.is_open() && !overwriting_) draw_unsaved();
  }
  if (draw_turntable_progress(recording_.get())) give_up_turntable("Cancelled");
  if (show_controls_) draw_controls_list(keymap(), show_controls_);
}

void ViewerApp::draw_interrupted() {
  using What = InterruptedChoice::What;
  const auto choice = draw_interrupted_panel(interrupted_);
  if (!choice) return;
  if (choice->what == What::later) return interrupted_.clear();
  const InterruptedEdit edit = interrupted_[choice->edit];
  interrupted_.erase(interrupted_.begin() + static_cast<std::ptrdiff_t>(choice->edit));
  if (choice->what == What::discard) return discard(edit);
  interrupted_.clear();
  leave_for([this, edit] {
    load({edit.opened}, [edit](Kernels& kernels, const Progress& progress) {
      return load_interrupted(edit, kernels, progress);
    });
  });
}

void ViewerApp::draw_unsaved() {
  const auto choice = draw_unsaved_panel(document_->opened.name);
  if (!choice) return;
  if (*choice == UnsavedChoice::save && document_->save_path.empty()) {
    return ask_for_path(PathPurpose::save_mesh);
  }
  const auto action = std::exchange(leaving_for_, nullptr);
  if (*choice == UnsavedChoice::save) return save_to(document_->save_path, action);
  if (*choice == UnsavedChoice::discard) action();
}

void ViewerApp::draw_start() {
  const auto choice = draw_start_panel({samples_, recent_.items(), start_trouble_},
                                       document_ ? &show_start_ : nullptr);
  if (!choice) return;
  if (const auto* path = std::get_if<std::filesystem::path>(&*choice)) {
    open(*path);
  } else if (const auto* shape = std::get_if<const NamedShape*>(&*choice)) {
    leave_for([this, shape = *shape] { show(load_shape(*shape)); });
  } else {
    ask_for_path(PathPurpose::open);
  }
}

double ViewerApp::draw_banner(const Eigen::Vector2d& corner, const Eigen::Vector2d& end) {
  const bool others = document_->desk.is_open() || document_->transplant.is_open();
  if (others && !document_->banner.is_empty()) return 0.0;
  DoctorBanner& banner = document_->banner;
  const bool had_picture = banner.has_picture();
  const auto wish = banner.draw(document_->editor, corner, end - corner);
  if (!had_picture && banner.has_picture()) document_->mesh_steps.give_way();
  if (!wish) return banner.height();
  switch (*wish) {
    case BannerWish::look_at_places:
      camera_before_ = camera_;
      if (banner.side()) camera_ = looking_at_side(camera_, *banner.side(), upward());
      frame(banner.places());
      zoom_by(1.0 / kRoomForBanner, 0.5 * size_);
      break;
    case BannerWish::look_back:
      camera_ = camera_before_;
      camera_.target_across = covered_share();
      break;
    case BannerWish::keep_repair:
      ask_for_path(PathPurpose::save_repaired);
      break;
    case BannerWish::open_another:
      ask_for_path(PathPurpose::open);
      break;
  }
  return banner.height();
}

}  // namespace lapwing::viewer
