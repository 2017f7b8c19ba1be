#pragma once

#include <cstdint>
#include <exception>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "files/recent_files.h"
#include "lapwing/base/stopwatch.h"
#include "lapwing/vulkan/vulkan_kernels.h"
#include "navigation/keymap.h"
#include "preferences/preferences.h"
#include "ui/document.h"
#include "ui/file_chooser.h"
#include "ui/load_file.h"
#include "ui/messages.h"
#include "ui/panels.h"
#include "ui/turntable_recording.h"
#include "window/app.h"
#include "work/job.h"

namespace lapwing::viewer {

/// A picture to take once the mesh is on the screen, after which the program ends, with an error
/// if there is one.
struct PictureOrder {
  std::filesystem::path path;
  std::optional<VkExtent2D> size;  ///< the window's unless given
};

/// Where the viewer keeps what outlives it. Without a name nothing of that kind is kept.
struct KeptFiles {
  std::filesystem::path journals;  ///< a folder
  std::filesystem::path preferences;
  std::filesystem::path recent;
};

/// The viewer: what is open, how it is looked at, and the panels around it. Its sources are by
/// concern: viewer_app (what is open), viewer_files (what is read and written), viewer_turntable
/// (what is saved from all around), viewer_input (mouse and keys), viewer_menus, viewer_sidebar,
/// viewer_dialogs (what is asked and offered over the picture), and viewer_frame (the rest of a
/// frame).
class ViewerApp final : public App {
 public:
  ViewerApp(std::shared_ptr<gpu::Context> context, KeptFiles kept);

  void order(PictureOrder picture) { order_ = std::move(picture); }
  /// What is open; null where nothing is.
  const Document* document() const { return document_.get(); }
  /// A file or folder, by the desktop's dialog or the browser.
  bool asks_for_path() const { return chooser_.is_open(); }
  /// Offers edits that a crash interrupted.
  void offer_interrupted();

  bool handle(const InputEvent& event) override;
  void open(const std::filesystem::path& file) override { open(file, {}); }
  /// `carry` follow the surface from the first edit by hand on.
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
  /// What is loaded, and what the person was asked for: where it cannot be, that is asked again.
  struct Loading {
    std::filesystem::path file;
    std::optional<PathPurpose> asked_for = {};
  };
  /// Begins with `load`, beside the window; what is still being loaded is given up.
  void load(Loading what, Load load);
  void show(LoadedFile file);
  void go_on_with(LoadedFile replay);
  void take_loaded();
  /// Goes on with `action`, which gives up what is open, once nothing is lost by it.
  void leave_for(std::function<void()> action);
  void ask_for_path(PathPurpose purpose);
  /// Says what is wrong with `path`, which was chosen or known for `purpose`, and asks for another.
  void ask_again(PathPurpose purpose, const std::filesystem::path& path, std::string trouble);
  std::string suggested_name(PathPurpose purpose) const;
  std::filesystem::path folder_to_ask_in(PathPurpose purpose) const;
  std::vector<BrowserPlace> places(PathPurpose purpose) const;
  /// Does `write`; where `file` is there already only after the person has said so, `otherwise`
  /// where not.
  void write_to(const std::filesystem::path& file, std::function<void()> write,
                std::function<void()> otherwise = {});
  void answer_overwriting(bool writes);
  /// Does `action` once the surface has settled, now or after a frame to come; where it does not
  /// settle, says that nothing was saved.
  void once_settled(std::function<void()> action);
  void take_settled();
  void take_recipe_check();
  /// And then does `then`, if it was saved.
  void save_to(const std::filesystem::path& path, std::function<void()> then = {});
  void save_carried();
  void save_recipe(const std::filesystem::path& path);
  void use_path(const ChosenPath& chosen);
  /// What the editor and its desks say; of a file that was just chosen, that is asked for again.
  void hear(Message message);
  void save_repaired(const std::filesystem::path& path);
  void save_chosen_picture(const std::filesystem::path& path);
  /// As the view shows it.
  RenderOptions picture_options(VkExtent2D size) const;
  void save_picture(const std::filesystem::path& path, VkExtent2D size) const;
  void carry_out_order();
  /// In a toast and the log.
  void say(Message message);
  void say(const WriteReport& report);
  double now() const;
  void say_of_colors();
  void take_preferred_tools();

  // A turntable.
  void save_turntable(const std::filesystem::path& path);
  void record_turntable();
  void give_up_turntable(const std::string& why);
  void draw_turntable();

  // Mouse and keys.
  void perform(Action action);
  void drag_to(const InputEvent& event);
  void escape();
  bool asks() const;
  PicturePlan window_picture() const;
  bool is_covered() const;
  void look_from(View view);
  void frame_all();
  void frame(std::span<const Index> vertices);
  void frame_points(std::span<const Eigen::Vector3d> points);
  void orbit_by(double right, double down);
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
  /// The part of the window that shows the source of a coat or mix.
  struct Area {
    Eigen::Vector2d corner;
    Eigen::Vector2d size;
    bool holds(const Eigen::Vector2d& pixel) const {
      return (pixel.array() >= corner.array()).all() &&
             (pixel.array() < (corner + size).array()).all();
    }
  };
  std::optional<Area> source_area() const;
  std::optional<bool> handle_source(const InputEvent& event);

  // The menu.
  void draw_menu();
  void draw_file_menu();
  void draw_recent_menu();
  void draw_edit_menu();
  void draw_view_menu();

  // The sidebar.
  /// What panels take, from the font of this frame: outside of frames that may be gone.
  void measure_panels();
  void draw_sidebar();
  void draw_sidebar_edge(float right, float top, float height);
  void follow_task();
  void draw_tabs();
  void draw_task(Task task);
  void draw_result();
  /// Frames vertices and points at them, until `look_back`.
  void show_vertices(const std::vector<Index>& vertices);
  void look_back();

  // What else is in a frame.
  void update_document();
  double pixels_per_unit() const;
  SurfaceStyle shown_style() const;
  PictureArea picture_area() const;
  void draw_marks();
  void draw_over_picture();
  void draw_machine(const FrameTimings& last);
  void keep_preferences();
  void draw_status();
  const std::string& status_text();
  const std::string& state_text();
  void draw_dialogs();
  void draw_start();
  void draw_interrupted();
  /// At the top of the picture, which goes from `corner` to `end`; how much of the height it takes.
  double draw_banner(const Eigen::Vector2d& corner, const Eigen::Vector2d& end);
  void draw_unsaved();
  void draw_picture();
  VkExtent2D window_size() const;

  std::shared_ptr<gpu::Context> context_;
  KeptFiles kept_;
  Preferences preferences_;
  Preferences kept_preferences_;  ///< as the file has them
  Job<LoadedFile> loader_;
  Loading loading_;
  Load load_again_;  ///< what is loading, where the device that is to show it fails; empty then
  std::unique_ptr<Document> document_;
  Camera camera_;
  Camera camera_before_;  ///< the doctor showed its places
  UpAxis up_axis_ = UpAxis::y;
  DisplayChoices display_;
  Eigen::Vector2d size_ = Eigen::Vector2d::Ones();
  double pixels_per_point_ = 1.0;
  std::optional<Motion> motion_;  ///< of the camera, under way
  Eigen::Vector2d cursor_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d pressed_at_ = Eigen::Vector2d::Zero();
  bool show_panels_ = true;
  bool shows_source_ = false;  ///< beside the mesh
  bool show_controls_ = false;
  bool show_machine_ = false;
  bool show_messages_ = false;
  bool show_start_ = true;
  Task task_ = Task::deform;           ///< whose tab is in front
  std::optional<Task> task_to_show_;   ///< in the next frame
  Task begun_task_ = Task::deform;     ///< the one that is open
  std::optional<Camera> view_before_;  ///< vertices were shown
  double sidebar_width_ = 0.0;         ///< in ImGui's units
  double covered_top_ = 0.0;           ///< likewise, of the picture, while the panels are shown
  double toolbar_height_ = 0.0;        ///< likewise
  double guide_height_ = 0.0;          ///< likewise
  double banner_height_ = 0.0;         ///< likewise
  PanelDrafts drafts_;
  EditMarks marks_;
  bool transplants_ = false;    ///< a part was in hand in the last frame
  PartPictures part_pictures_;  ///< not the document's: a frame may show them when that is closed
  PicturePlan picture_plan_;
  TurntablePlan turntable_plan_;
  std::unique_ptr<TurntableRecording> recording_;
  FileChooser chooser_;
  std::optional<ChosenPath> chosen_;  ///< that the editor or a desk is reading
  RecentFiles recent_;
  std::filesystem::path last_folder_;  ///< that a file was chosen in
  std::vector<InterruptedEdit> interrupted_;
  /// A file that is there already, and what to do once the person has said.
  struct Overwriting {
    std::filesystem::path file;
    std::function<void()> write;
    std::function<void()> otherwise;
  };
  std::optional<Overwriting> overwriting_;
  std::function<void()> saving_;       ///< waits for the surface to settle
  std::function<void()> leaving_for_;  ///< waits for the person to say what becomes of the edit
  std::vector<std::filesystem::path> samples_;
  std::string start_trouble_;  ///< why what was to be opened is not
  Stopwatch started_;
  Messages messages_;
  std::string status_line_;  ///< kept from one frame to the next
  std::string state_line_;
  std::string title_ = "Lapwing";
  std::optional<PictureOrder> order_;
  std::exception_ptr order_failure_;  ///< what no other device mends
  int frames_shown_ = 0;              ///< of the document
  bool quit_ = false;
};

}  // namespace lapwing::viewer
