// Dialogs and the banner over the picture.

#include <cmath>
#include <imgui.h>

#include "files/typed_path.h"
#include "navigation/camera_motion.h"
#include "ui/viewer_app.h"

namespace lapwing::viewer {
namespace {

// The picture is this much larger than what the doctor shows.
constexpr double kRoomForBanner = 1.4;

// Returns a camera that looks from `side`, turned a little towards the view before, so that the
// user sees where it is.
Camera looking_at_side(const Camera& camera, const Eigen::Vector3d& side,
                       const Eigen::Vector3d& up) {
  constexpr double kTowardsBefore = 0.4;
  constexpr double kParallel = 0.98;
  const Eigen::Matrix4d view = camera.view();
  const Eigen::Vector3d before = view.block<1, 3>(2, 0).transpose();
  const Eigen::Vector3d toward_eye = (side + kTowardsBefore * before).normalized();
  // If the view goes along the mesh's up axis, keep what is up on the screen.
  const Eigen::Vector3d on_screen = view.block<1, 3>(1, 0).transpose();
  const bool along_up = std::abs(toward_eye.dot(up)) > kParallel;
  return looking_from(camera, {toward_eye, along_up ? on_screen : up});
}

}  // namespace

void ViewerApp::draw_picture() {
  if (chooser_.is_open()) return;
  if (draw_picture_panel(picture_plan_)) ask_for_path(PathPurpose::save_picture);
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

void ViewerApp::draw_recent_menu() {
  if (!ImGui::BeginMenu("Open recent")) return;
  if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape))) ImGui::CloseCurrentPopup();
  if (ImGui::IsWindowAppearing()) recent_.reload();
  std::optional<std::filesystem::path> chosen;
  for (const RecentFiles::Item& item : recent_.items()) {
    if (ImGui::MenuItem(with_tilde(item.path).c_str(), nullptr, false, item.is_there)) {
      chosen = item.path;
    }
  }
  if (recent_.items().empty()) ImGui::TextDisabled("What you open is listed here.");
  ImGui::Separator();
  if (ImGui::MenuItem("Forget these", nullptr, false, !recent_.items().empty())) recent_.clear();
  ImGui::EndMenu();
  if (chosen) open(*chosen);
}

double ViewerApp::draw_banner(const Eigen::Vector2d& corner, const Eigen::Vector2d& end) {
  const bool others = document_->desk.is_open() || document_->transplant.is_open();
  if (others && !document_->banner.is_empty()) return 0.0;
  DoctorBanner& banner = document_->banner;
  const auto wish = banner.draw(document_->editor, corner, end - corner);
  if (!wish) return banner.height();
  switch (*wish) {
    case BannerWish::look_at_places:
      camera_before_ = camera_;
      if (banner.side()) camera_ = looking_at_side(camera_, *banner.side(), upward());
      frame(banner.places());
      // The banner covers a part of the picture.
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
