#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lapwing/render/id_picture.h"
#include "lapwing/vulkan/vulkan_kernels.h"
#include "navigation/keymap.h"
#include "ui/document.h"
#include "ui/file_loader.h"
#include "ui/panels.h"
#include "window/app.h"

namespace lapwing::viewer {

/// A picture to take once the mesh is on the screen, after which the program ends, with an error
/// if there is one.
struct PictureOrder {
  std::filesystem::path path;
  std::optional<VkExtent2D> size;  ///< the window's unless given
};

/// The viewer: shows a mesh, moves the camera around it, says what is there.
class ViewerApp final : public App {
 public:
  explicit ViewerApp(std::shared_ptr<gpu::Context> context);

  void order(PictureOrder picture) { order_ = std::move(picture); }

  bool handle(const InputEvent& event) override;
  void open(const std::filesystem::path& file) override;
  void resize(const Eigen::Vector2d& size) override;
  void draw_ui(const FrameTimings& last) override;
  Scene scene() override;
  std::string_view title() const override { return title_; }
  bool wants_to_quit() const override { return quit_; }
  void use_device(std::shared_ptr<gpu::Context> context) override;

 private:
  void show(LoadedFile file);
  void take_loaded();
  /// Says something in the status line and the log.
  void say(std::string message);

  void perform(Action action);
  void drag_to(const InputEvent& event);
  void look_from(View view);
  void frame_all();
  void orbit_by(double right, double down);
  void zoom_by(double factor, const Eigen::Vector2d& cursor);
  void say_what_is_at(const Eigen::Vector2d& pixel);
  Eigen::Vector3d upward() const;
  bool is_inside(const Bounds& bounds) const;
  double sidebar_share() const;
  double sidebar_pixels() const;

  void draw_menu();
  void draw_view_menu();
  void draw_sidebar(const FrameTimings& last);
  void draw_status(const FrameTimings& last);
  void draw_picture_panel();
  VkExtent2D window_size() const;
  void save_picture(const std::filesystem::path& path, VkExtent2D size) const;
  void carry_out_order();

  std::shared_ptr<gpu::Context> context_;
  std::optional<VulkanKernels> kernels_;
  FileLoader loader_;
  std::optional<IdPicture> id_picture_;
  std::optional<Document> document_;
  Camera camera_;
  UpAxis up_axis_ = UpAxis::y;
  DisplayChoices display_;
  std::size_t keymap_ = 0;  ///< of keymaps()
  Eigen::Vector2d size_ = Eigen::Vector2d::Ones();
  std::optional<Motion> motion_;  ///< under way
  Eigen::Vector2d cursor_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d pressed_at_ = Eigen::Vector2d::Zero();
  bool show_panels_ = true;
  bool show_controls_ = false;
  bool show_start_ = true;
  PicturePlan picture_plan_;
  std::vector<std::filesystem::path> samples_;
  std::string typed_path_;
  std::vector<std::string> log_;
  std::string status_;
  std::string title_ = "Lapwing";
  std::optional<PictureOrder> order_;
  int frames_shown_ = 0;  ///< of the document
  bool quit_ = false;
};

}  // namespace lapwing::viewer
