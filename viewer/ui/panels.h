#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "editing/detail_transfer_tool.h"
#include "editing/editor.h"
#include "editing/guide.h"
#include "editing/mesh_step_tool.h"
#include "editing/part_library_view.h"
#include "editing/wrap_tool.h"
#include "files/file_purpose.h"
#include "files/recent_files.h"
#include "lapwing/gpu/devices.h"
#include "lapwing/mesh/shapes.h"
#include "navigation/keymap.h"
#include "preferences/preferences.h"
#include "state/app_state.h"
#include "ui/document.h"
#include "ui/messages.h"
#include "ui/turntable_recording.h"
#include "window/app.h"
#include "window/ui_renderer.h"

namespace lapwing::viewer {

/// Values that the user is editing. They become a command when the field or slider is released.
struct PanelDrafts {
  std::optional<double> belt_percent;
  std::optional<SetFalloff> falloff;
  std::optional<SimilarityMove> move;
  std::optional<EditParameters> parameters;
  LastSolveOptions settling;
  std::size_t history_shown = 0;  ///< step that the list was scrolled to
  std::string part_name;          ///< name of the part to cut
};

// The panels. Each draws itself with ImGui in a window that the caller has begun, and changes only
// its arguments.

/// The tabs of the sidebar.
enum class Task { deform, coat, mix, wrap, transplant, mesh, display };

/// Returns the height of the status line, in ImGui's units.
float status_height();

/// Draws the mesh's name, its sizes and the defects that the mesh doctor found. Appends `unit` to
/// lengths if it is not empty.
void draw_mesh_panel(const Document& document, const std::string& unit);

/// Draws the holes of the surface, and the commands that change its triangles. `size` is the
/// diagonal of the bounding box of the mesh. Returns the rim of the hole that the user wants to
/// see.
std::optional<std::vector<Index>> draw_mesh_steps(MeshStepTool& tool, const Editor& editor,
                                                  double size);
/// Draws Apply, Cancel and the result of the command whose preview is open.
void draw_mesh_step_result(MeshStepTool& tool, Editor& editor);

/// Describes a rectangle of the window, in ImGui's units unless stated otherwise.
struct PictureArea {
  Eigen::Vector2d corner;  ///< upper left
  Eigen::Vector2d size;

  bool holds(const Eigen::Vector2d& point) const {
    return (point.array() >= corner.array()).all() &&
           (point.array() < (corner + size).array()).all();
  }
};

/// Draws what the tools choose, and the tools, along the top of the area, in as many rows as
/// needed. Returns the height.
double draw_toolbar(Editor& editor, const PictureArea& area);

/// Draws the selection, buttons that edit it, and how firmly the handles hold. Here and below,
/// `unit` follows lengths; it may be empty.
void draw_selection_panel(Editor& editor, PanelDrafts& drafts, const std::string& unit);

/// Draws the handle's move in numbers, and how the edit is computed.
void draw_deform_panel(Editor& editor, PanelDrafts& drafts, const std::string& unit);

/// Requests from the result panel.
struct ResultWish {
  std::optional<std::vector<Index>> show;  ///< vertices to show
  bool back = false;                       ///< return to the view before vertices were shown
};
/// Draws the worker's progress and the certificate of the result. `points`: vertices are being
/// shown.
ResultWish draw_result_panel(Editor& editor, bool points);

/// Holds the thumbnails of a library's parts on the device.
class PartPictures {
 public:
  /// Uploads the thumbnails of `library` if they have changed. `context` must outlive them. Call
  /// this before the panels are laid out.
  void renew(const PartLibraryView& library, gpu::Context& context);
  /// Releases everything on the device.
  void release();

  /// Returns the thumbnail of item `k` of the library, or null if it has none.
  const UiPicture* of(std::size_t k) const { return pictures_[k].get(); }

 private:
  std::vector<std::unique_ptr<UiPicture>> pictures_;
  std::uint64_t version_ = 0;  // of the library
};

/// Draws the parts, the one being placed, and how it is joined. Returns the purpose if the user
/// wants to choose a path.
std::optional<PathPurpose> draw_transplant_panel(TransplantTool& desk, const PartPictures& pictures,
                                                 Editor& editor, PanelDrafts& drafts);
/// Draws Apply, Cancel and the result of an open transplant.
void draw_transplant_result(TransplantTool& desk, Editor& editor);

/// Draws the coat or mix of `task`: its source, target and parameters. If none is open, draws how
/// to begin one. Returns the purpose if the user wants to open another source.
std::optional<PathPurpose> draw_layer_panel(DetailTransferTool& desk, Editor& editor, Task task,
                                            const std::string& unit);
/// Draws Apply, Cancel and the result of an open coat or mix.
void draw_layer_result(DetailTransferTool& desk, Editor& editor);
/// Requests from the Wrap tab.
struct WrapWish {
  std::optional<PathPurpose> path = {};
  std::filesystem::path coat = {};  ///< the scan whose detail the Coat tab should use; may be empty
};
/// Draws the scan, landmarks and settings of the open wrap, and a legend in the colours of `style`.
/// If no wrap is open, draws a button that opens a scan.
WrapWish draw_wrap_panel(WrapTool& wrap, Editor& editor, const SurfaceStyle& style);
/// Draws Wrap, Apply, Cancel and the report of an open wrap.
WrapWish draw_wrap_result(WrapTool& wrap, Editor& editor);
/// Draws the domain with the edges of both patches, the source's below, as wide as the panel.
/// Without `layers`, draws only the frame.
void draw_domain(const LayeredCoat* layers, std::size_t source);

/// Draws the files that follow the surface. Returns the action if the user wants to add one or save
/// them.
std::optional<Action> draw_carried_panel(Editor& editor);

/// Draws all steps, to go back and forth. Returns the purpose if the user wants to save or replay a
/// recipe.
std::optional<PathPurpose> draw_history_panel(Editor& editor, PanelDrafts& drafts);

/// What the colours of the surface show.
enum class Coloring { plain, regions, displacement, rotation, detail, stretch };
std::optional<PoseMeasure> measure_of(Coloring coloring);
/// Title of the legend of a wrap's distances.
inline constexpr const char* kScanDistance = "distance from the scan\n(% of its diagonal)";
/// Draws the colours of `style` with the ends of its range, as wide as the panel.
void draw_legend(const SurfaceStyle& style);

/// The choices in the Display tab.
struct DisplayChoices {
  SurfaceStyle style{.file_colors = true};
  Background background = Background::gradient;
  bool grid = false;  ///< draw the ground grid
  Coloring coloring = Coloring::regions;
  float feature_angle = static_cast<float>(kFeatureAngleDegrees);
};
/// Returns the style that shows `editor` as chosen.
SurfaceStyle style_of(const DisplayChoices& choices, const Editor& editor);
void draw_display_panel(DisplayChoices& choices, Editor& editor);

/// Draws the device, the numbers of the solver and the times of a frame in a separate window. Sets
/// `open` to false when the user closes it.
void draw_machine_panel(const gpu::DeviceDescription& device, const FrameTimings& timings,
                        const Certificate* certificate, bool& open);

/// Draws all messages in a separate window, oldest first. Sets `open` to false if the user closes
/// this window.
void draw_messages_panel(const Messages& messages, bool& open);
/// Draws warnings and errors in the upper right corner of the 3D view until the user closes them.
/// Draws the current note in the lower left corner, where it does not capture mouse events. Returns
/// the index in `steps` of the step that the user wants to edit because of a warning.
std::optional<std::size_t> draw_toasts(Messages& messages, const PictureArea& area,
                                       std::span<const std::shared_ptr<const Step>> steps);

/// Draws theme, mouse, unit, guide and file dialogs.
void draw_preferences_panel(Preferences& preferences);

/// Draws marks over the scene and under the panels: the gizmo, outlines of the tools and
/// highlighted vertices. Reuses its memory in later frames.
class EditMarks {
 public:
  /// `pixels_per_unit` is the number of pixels of `view` per unit of ImGui.
  void draw(const Editor& editor, const ViewFrame& view, double pixels_per_unit,
            const Eigen::Vector2d& cursor);
  /// Draws the numbered pairs of points of a coat or mix, on the target and on the source, whose
  /// view is at `corner`.
  void draw(const DetailTransferTool& desk, const Editor& editor, const ViewFrame& view,
            const Eigen::Vector2d& corner, double pixels_per_unit);
  /// Like the function above, for the landmarks of a wrap. Each pair has its own colour.
  void draw(const WrapTool& wrap, const Editor& editor, const ViewFrame& view,
            const Eigen::Vector2d& corner, double pixels_per_unit);
  /// Draws the line between the two panes of `area` and their names. The left one is `width` wide,
  /// in ImGui's units.
  void draw_panes(const std::string& left, const std::string& right, const PictureArea& area,
                  double width);
  /// Draws the loops of a transplant's part and hole, and the part's gizmo.
  void draw_transplant(const TransplantTool& desk, const ViewFrame& view, double pixels_per_unit);
  /// Draws the line between the original and the edited mesh, with their names below `top`. `line`
  /// and `top` are in pixels.
  void draw_slider(const ViewFrame& view, double pixels_per_unit, double line, double top);

 private:
  GizmoLines gizmo_;
  std::string readout_;
  std::vector<Eigen::Vector2d> points_;
};

/// Draws the steps of the task and the next action in the lower left corner of the 3D view, where
/// they do not capture mouse events. Returns the height of the guide.
double draw_guide(const Guide& guide, const PictureArea& area);

/// Draws the list of controls in a separate window. Sets `open` to false when the user closes it.
void draw_controls_list(const Keymap& keymap, bool& open);

/// What the user chose to open: a file, a generated mesh, or a file to be asked for.
struct AnotherFile {};
using Choice = std::variant<std::filesystem::path, const NamedShape*, AnotherFile>;
/// Meshes to begin with.
struct StartOffer {
  std::span<const std::filesystem::path> samples;
  std::span<const RecentFiles::Item> recent;
  const std::string& trouble;  ///< why the last one could not be opened; empty otherwise
};
/// Offers them and generated ones in a separate window. Sets `*open` to false when the user closes
/// it; if `open` is null, it cannot be closed.
std::optional<Choice> draw_start_panel(const StartOffer& offer, bool* open);

/// The settings of an image to save.
struct PicturePlan {
  bool open = false;  ///< whether the panel is shown
  int width = 0;      ///< in pixels, both at least 1
  int height = 0;
};
/// Asks for the image size in a separate window. Returns true if the user wants to choose the file.
bool draw_picture_panel(PicturePlan& plan);

/// The settings of a turntable to save, a series of images from all around the mesh.
struct TurntablePlan {
  PicturePlan picture;  ///< size of each image
  int count = 120;      ///< at least 1
  double per_second = 30.0;
};
/// Asks for these settings in a separate window. Returns true if the user wants to choose the file.
bool draw_turntable_panel(TurntablePlan& plan);
/// Draws the progress in a modal window and returns true if the user cancels. If `recording` is
/// null, closes the window. Must be called in every frame.
bool draw_turntable_progress(const TurntableRecording* recording);

/// Asks in a separate window whether to overwrite a file. Returns nullopt until the user answers.
std::optional<bool> draw_overwrite_panel(const std::filesystem::path& file);

/// What to do with an edit that is not saved.
enum class UnsavedChoice { save, discard, cancel };
/// Asks in a separate window. Returns nullopt until the user answers.
std::optional<UnsavedChoice> draw_unsaved_panel(const std::string& name);

/// What to do with an edit that a crash interrupted.
struct InterruptedChoice {
  std::size_t edit = 0;  ///< index of the edit
  enum class What { restore, discard, later } what = What::later;
};
/// Likewise.
std::optional<InterruptedChoice> draw_interrupted_panel(std::span<const InterruptedEdit> edits);

/// Returns sample meshes and recipes that tools/demo and tools/test have fetched. Looks in
/// build/models and tools/recipes here, and beside the program's build folder.
std::vector<std::filesystem::path> find_samples();

}  // namespace lapwing::viewer
