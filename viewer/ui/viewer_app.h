#pragma once

#include <cstdint>
#include <exception>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "files/load_file.h"
#include "files/recent_files.h"
#include "lapwing/base/stopwatch.h"
#include "lapwing/vulkan/vulkan_kernels.h"
#include "navigation/keymap.h"
#include "preferences/preferences.h"
#include "ui/document.h"
#include "ui/file_chooser.h"
#include "ui/messages.h"
#include "ui/panels.h"
#include "ui/turntable_recording.h"
#include "window/app.h"
#include "work/job.h"

namespace lapwing::viewer {

/// Requests an image that is saved after the first frame with the mesh. The program then exits. Its
/// exit code reports whether the image was saved.
struct PictureOrder {
  std::filesystem::path path;
  std::optional<VkExtent2D> size;  ///< the window's by default
};

/// The paths of the files that the viewer keeps between runs. An empty path disables a file.
struct KeptFiles {
  std::filesystem::path journals;  ///< a folder
  std::filesystem::path preferences;
  std::filesystem::path recent;
};

/// Runs the viewer: holds the open document and its 3D view, and draws the panels. Each source file
/// has one purpose: viewer_app (the document), viewer_files (reading and writing), viewer_pictures
/// (images and turntables), viewer_input (mouse and keys), viewer_menus, viewer_sidebar,
/// viewer_dialogs (dialogs and the banner), and viewer_frame (the rest of a frame).
class ViewerApp final : public App {
 public:
  ViewerApp(std::shared_ptr<gpu::Context> context, KeptFiles kept);

  void order(PictureOrder picture) { order_ = std::move(picture); }
  /// Returns the open document; null if there is none.
  const Document* document() const { return document_.get(); }
  /// Returns whether the desktop's dialog or the browser is open.
  bool asks_for_path() const { return chooser_.is_open(); }
  /// Offers to restore edits that a crash interrupted.
  void offer_interrupted();

  bool handle(const InputEvent& event) override;
  void open(const std::filesystem::path& file) override { open(file, {}); }
  /// The files in `carry` follow the surface from the first edit in the viewer on.
  void open(const std::filesystem::path& file, const std::vector<std::filesystem::path>& carry,
            std::optional<PathPurpose> asked_for = {});
  void resize(const Eigen::Vector2d& size, double pixels_per_point) override;
  void draw_ui(const FrameTimings& last) override;
  Scene scene() override;
  std::string_view title() const override;
  Theme theme() const override { return preferences_.theme; }
  void ask_to_close() override;
  bool wants_to_quit() const override { return quit_; }
  void use_device(std::shared_ptr<gpu::Context> context) override;

 private:
  // Files.
  using Load = std::function<LoadedFile(Kernels& kernels, const Progress& progress)>;
  /// The file that is being loaded. If loading fails, the user is asked for another file for the
  /// purpose `asked_for`.
  struct Loading {
    std::filesystem::path file;
    std::optional<PathPurpose> asked_for = {};
  };
  /// Starts `load` on another thread. Cancels the previous load if it is not finished.
  void load(Loading what, Load load);
  void show(LoadedFile file);
  void go_on_with(LoadedFile replay);
  void take_loaded();
  /// Runs `action`, which closes the document. If there are unsaved changes, asks the user first.
  void leave_for(std::function<void()> action);
  void ask_for_path(PathPurpose purpose);
  /// Tells the user why `path` cannot be used, and asks for another path for `purpose`.
  void ask_again(PathPurpose purpose, const std::filesystem::path& path, std::string trouble);
  std::string suggested_name(PathPurpose purpose) const;
  std::filesystem::path folder_to_ask_in(PathPurpose purpose) const;
  std::vector<BrowserPlace> places(PathPurpose purpose) const;
  /// Runs `write`. If `file` exists, first asks the user whether to overwrite it. If the user
  /// declines, runs `otherwise` instead.
  void write_to(const std::filesystem::path& file, std::function<void()> write,
                std::function<void()> otherwise = {});
  void answer_overwriting(bool writes);
  /// Runs `action` once the surface has settled. If settling fails, reports that nothing was saved.
  void once_settled(std::function<void()> action);
  void take_settled();
  void take_recipe_check();
  /// Saves the mesh, and runs `then` if that succeeds.
  void save_to(const std::filesystem::path& path, std::function<void()> then = {});
  void save_carried();
  void save_recipe(const std::filesystem::path& path);
  void use_path(const ChosenPath& chosen);
  /// Takes a message of the editor or its desks. If it is about the file that was just chosen, asks
  /// again.
  void hear(Message message);
  void save_repaired(const std::filesystem::path& path);
  /// Shows a message in a toast and adds it to the log.
  void say(Message message);
  void say(const WriteReport& report);
  double now() const;
  void say_of_colors();
  void take_preferred_tools();

  // Images and turntables.
  PicturePlan window_picture() const;
  /// Returns the options for rendering the current view into an image of `size` pixels.
  RenderOptions picture_options(VkExtent2D size) const;
  void save_picture(const std::filesystem::path& path, VkExtent2D size) const;
  void save_chosen_picture(const std::filesystem::path& path);
  void carry_out_order();
  void save_turntable(const std::filesystem::path& path);
  void record_turntable();
  void give_up_turntable(const std::string& why);

  // Mouse and keys.
  void perform(Action action);
  void drag_to(const InputEvent& event);
  void escape();
  bool cancel_layers();
  bool asks() const;
  bool is_covered() const;
  void look_from(View view);
  void frame_all();
  void frame(std::span<const Index> vertices);
  void frame_points(std::span<const Eigen::Vector3d> points);
  void orbit_by(double right, double down, const Eigen::Vector3d& center);
  /// Focuses the camera on the surface point at `pixel` and returns it. If no surface is there,
  /// returns the camera's target.
  Eigen::Vector3d focus(const Eigen::Vector2d& pixel);
  /// Returns the centre of the axis gizmo in pixels; nullopt if it is hidden.
  std::optional<Eigen::Vector2d> axis_gizmo_center() const;
  /// Returns the position of the slider's line, in pixels from the left; nullopt if the slider is
  /// off.
  std::optional<double> slider_line() const;
  /// Handles a drag of the slider's line. Returns whether the event belongs to such a drag.
  bool handle_slider(const InputEvent& event);
  void toggle_slider();
  /// Handles a press or release on the axis gizmo. Returns whether the gizmo has taken the event.
  bool handle_axis_gizmo(const InputEvent& event);
  bool is_click(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const;
  void zoom_by(double factor, const Eigen::Vector2d& cursor);
  Eigen::Vector3d upward() const;
  ViewFrame view_frame() const;
  const Keymap& keymap() const;
  void use_mouse_of(const std::string& keymap);
  GizmoKeys gizmo_keys() const;
  bool is_inside(const Bounds& bounds) const;
  double covered_share() const;
  double sidebar_pixels() const;
  /// Returns the rectangle of the window, in pixels, in which the source of a coat or mix is shown.
  std::optional<PictureArea> source_area() const;
  std::optional<bool> handle_source(const InputEvent& event);

  // The menu.
  void draw_menu();
  void draw_file_menu();
  void draw_recent_menu();
  void draw_edit_menu();
  void draw_view_menu();

  // The sidebar.
  /// Measures the panels by the font of this frame, which may be gone outside of frames.
  void measure_panels();
  void draw_sidebar();
  void draw_sidebar_edge(float right, float top, float height);
  void follow_task();
  void draw_tabs();
  void draw_task(Task task);
  void draw_mesh_commands();
  void draw_result();
  /// Frames vertices and points at them, until `look_back`.
  void show_vertices(const std::vector<Index>& vertices);
  void look_back();

  // The rest of a frame.
  void update_document();
  double pixels_per_unit() const;
  SurfaceStyle shown_style() const;
  std::optional<GroundGrid> shown_grid() const;
  PictureArea picture_area() const;
  void draw_marks();
  void draw_over_picture();
  void keep_preferences();
  void draw_status();
  const std::string& status_text();
  void draw_dialogs();
  void draw_start();
  void draw_interrupted();
  /// Draws the banner at the top of the picture, which goes from `corner` to `end`. Returns its
  /// height.
  double draw_banner(const Eigen::Vector2d& corner, const Eigen::Vector2d& end);
  void draw_unsaved();

  std::shared_ptr<gpu::Context> context_;
  KeptFiles kept_;
  Preferences preferences_;
  Preferences kept_preferences_;  ///< as in the file
  Job<LoadedFile> loader_;
  Loading loading_;
  Load load_again_;  ///< repeats the load once if the device fails; empty afterwards
  std::unique_ptr<Document> document_;
  Camera camera_;
  Camera camera_before_;  ///< before the doctor showed its places
  UpAxis up_axis_ = UpAxis::y;
  DisplayChoices display_;
  Eigen::Vector2d size_ = Eigen::Vector2d::Ones();
  double pixels_per_point_ = 1.0;
  std::optional<Motion> motion_;  ///< camera motion under way
  /// Position of the slider's line in the area that the panels do not cover, from 0 at its left
  /// edge to 1 at its right edge.
  std::optional<double> slider_;
  bool on_slider_ = false;      ///< its line is being dragged
  bool on_axis_gizmo_ = false;  ///< the motion began on the axis gizmo
  Eigen::Vector2d cursor_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d pressed_at_ = Eigen::Vector2d::Zero();
  Eigen::Vector3d orbit_center_ = Eigen::Vector3d::Zero();
  bool show_panels_ = true;
  bool shows_source_ = false;  ///< beside the mesh
  bool show_controls_ = false;
  bool show_machine_ = false;
  bool show_messages_ = false;
  bool show_start_ = true;
  std::optional<Task> task_to_show_;   ///< the tab to bring to the front
  Task begun_task_ = Task::deform;     ///< the task that is open
  std::optional<Camera> view_before_;  ///< before vertices were shown
  double sidebar_width_ = 0.0;         ///< in ImGui's units
  double covered_top_ = 0.0;           ///< likewise, of menu and tools, while the panels are shown
  double toolbar_height_ = 0.0;        ///< likewise
  double guide_height_ = 0.0;          ///< likewise
  double banner_height_ = 0.0;         ///< likewise
  PanelDrafts drafts_;
  EditMarks marks_;
  bool transplants_ = false;    ///< a transplant was open in the last frame
  PartPictures part_pictures_;  ///< outlive the document, which a frame may show
  PicturePlan picture_plan_;
  TurntablePlan turntable_plan_;
  std::unique_ptr<TurntableRecording> recording_;
  FileChooser chooser_;
  std::optional<ChosenPath> chosen_;  ///< being read by the editor or a desk
  RecentFiles recent_;
  std::filesystem::path last_folder_;  ///< where a file was last chosen
  std::vector<InterruptedEdit> interrupted_;
  /// A file that exists, and what to do after the user's answer.
  struct Overwriting {
    std::filesystem::path file;
    std::function<void()> write;
    std::function<void()> otherwise;
  };
  std::optional<Overwriting> overwriting_;
  std::function<void()> saving_;       ///< waits for the surface to settle
  std::function<void()> leaving_for_;  ///< waits for the user to save or discard the edit
  std::vector<std::filesystem::path> samples_;
  std::string start_trouble_;  ///< why the last file could not be opened
  Stopwatch started_;
  Messages messages_;
  std::string status_line_;  ///< reused from frame to frame
  std::string state_line_;
  std::optional<PictureOrder> order_;
  std::exception_ptr order_failure_;  ///< an error that another device would not fix
  int frames_shown_ = 0;              ///< of the document
  bool quit_ = false;
};

}  // namespace lapwing::viewer
