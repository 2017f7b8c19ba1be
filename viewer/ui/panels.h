#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <variant>

#include "editing/desk_guides.h"
#include "editing/editor.h"
#include "editing/layer_desk.h"
#include "files/file_purpose.h"
#include "files/recent_files.h"
#include "lapwing/gpu/devices.h"
#include "lapwing/mesh/shapes.h"
#include "navigation/keymap.h"
#include "preferences/preferences.h"
#include "state/kept_settling.h"
#include "ui/document.h"
#include "ui/messages.h"
#include "ui/part_pictures.h"
#include "ui/turntable_recording.h"
#include "window/app.h"

namespace lapwing::viewer {

/// What a person is about to choose: numbers become a command when the field or slider is let go.
struct PanelDrafts {
  std::optional<double> belt_percent;
  std::optional<SetGrading> grading;
  std::optional<SimilarityMove> move;
  std::optional<EditParameters> parameters;
  KeptSettling settling;
  std::size_t history_shown = 0;  ///< step that the list was scrolled to
  std::string part_name;          ///< of what is to be cut
};

// The panels. Each lays itself out with ImGui where the caller has begun a window, and changes only
// what it is given.

/// What the sidebar has a tab for.
enum class Task { deform, coat, mix, transplant, mesh, display };

/// In ImGui's units, of the line at the bottom of the window.
float status_height();

/// File, sizes, and what the mesh doctor found. Lengths with `unit`, if there is one.
void draw_mesh_panel(const Document& document, const std::string& unit);

/// A part of the window, in ImGui's units.
struct PictureArea {
  Eigen::Vector2d corner;  ///< the upper left one
  Eigen::Vector2d size;
};

/// What the tools choose, and the tools, along the top of the area, as many rows as they take. Its
/// height.
double draw_toolbar(Editor& editor, const PictureArea& area);

/// What is chosen, what else can be done to that, and how its handles hold.
void draw_selection_panel(Editor& editor, PanelDrafts& drafts);

/// The handle's move in numbers, and how the edit is computed.
void draw_deform_panel(Editor& editor, PanelDrafts& drafts);

/// What a person wants of a result.
struct ResultWish {
  std::optional<std::vector<Index>> show;  ///< these vertices
  bool back = false;                       ///< to the view before vertices were shown
};
/// How far the worker is, and what the result promises. `points`: vertices are being shown.
ResultWish draw_result_panel(Editor& editor, bool points);

/// Parts, the one in hand, and how it is sewn on; what a person wants to be asked for.
std::optional<PathPurpose> draw_transplant_panel(TransplantDesk& desk, const PartPictures& pictures,
                                                 Editor& editor, PanelDrafts& drafts);
/// Apply and cancel, and what the transplant comes to, while one is open.
void draw_transplant_result(TransplantDesk& desk, Editor& editor);

/// A coat or a mix in the making, as `task` says: where it comes from, where it goes, and how;
/// whether another source is to be opened. Without one of that kind, how to begin one.
std::optional<PathPurpose> draw_layer_panel(LayerDesk& desk, Editor& editor, Task task);
/// Apply and cancel, and what the coat or mix comes to, while one is open.
void draw_layer_result(LayerDesk& desk, Editor& editor);
/// Its part for the weight of a mix.
void draw_mix_weight(LayerDesk& desk, Editor& editor);

/// Files that follow the surface; what a person wants besides: another one, or to save them.
std::optional<Action> draw_carried_panel(Editor& editor);

/// All steps, to go back and forth; what a person wants to do with them as a recipe.
std::optional<PathPurpose> draw_history_panel(Editor& editor, PanelDrafts& drafts);

/// What the surface is coloured by.
enum class Coloring { plain, regions, displacement, rotation, detail, stretch };
std::optional<PoseMeasure> measure_of(Coloring coloring);

/// How the picture looks.
struct DisplayChoices {
  SurfaceStyle style{.file_colors = true};
  Background background = Background::gradient;
  Coloring coloring = Coloring::regions;
};
/// The style that shows `editor` as chosen.
SurfaceStyle style_of(const DisplayChoices& choices, const Editor& editor);
void draw_display_panel(DisplayChoices& choices, Editor& editor);

/// What each part of a frame took.
void draw_timings_panel(const FrameTimings& timings);

/// The device, the numbers of the solver, and what each part of a frame took, in a window of its
/// own; `open` turns false when it is closed.
void draw_machine_panel(const gpu::DeviceDescription& device, const FrameTimings& timings,
                        const Certificate* certificate, bool& open);

/// Messages, the newest last.
void draw_log_panel(std::span<const Message> messages);
/// The same in a window of its own; `open` turns false when it is closed.
void draw_messages_panel(const Messages& messages, bool& open);
/// What is still to be read: warnings and errors at the upper right corner of the picture, each
/// until it is closed, the note at its lower left corner, where it lets the mouse through.
void draw_toasts(Messages& messages, const PictureArea& area);

/// Theme, mouse, unit and guide.
void draw_preferences_panel(Preferences& preferences);

/// Over the picture, under the panels: gizmo, outlines of the tools, vertices pointed at. Keeps its
/// memory from one frame to the next.
class EditMarks {
 public:
  /// Pixels of `view` for each of ImGui's units.
  void draw(const Editor& editor, const ViewFrame& view, double pixels_per_unit,
            const Eigen::Vector2d& cursor);
  /// Of a coat or mix: the pairs of points, numbered, on the target and on the source, whose view
  /// is at `corner`.
  void draw(const LayerDesk& desk, const Editor& editor, const ViewFrame& view,
            const Eigen::Vector2d& corner, double pixels_per_unit);
  /// Which of the two panes of `area` is what; the source's is `width` wide, in ImGui's units.
  void draw_pane_names(const LayerDesk& desk, const std::string& target, const PictureArea& area,
                       double width);
  /// Of a transplant: the loops of part and hole, and the part's gizmo.
  void draw_transplant(const TransplantDesk& desk, const ViewFrame& view, double pixels_per_unit);

 private:
  GizmoLines gizmo_;
  std::string readout_;
  std::vector<Eigen::Vector2d> points_;
};

/// The steps of what is done and what to do now, at the lower left corner of the picture; it lets
/// the mouse through. The height that it takes.
double draw_guide(const Guide& guide, const PictureArea& area);

/// The list of controls, in a window of its own; `open` turns false when it is closed.
void draw_controls_list(const Keymap& keymap, bool& open);

/// What a person chose to open: a file, a generated mesh, or one to be asked for.
struct AnotherFile {};
using Choice = std::variant<std::filesystem::path, const NamedShape*, AnotherFile>;
/// Meshes to begin with.
struct StartOffer {
  std::span<const std::filesystem::path> samples;
  std::span<const RecentFiles::Item> recent;
  const std::string& trouble;  ///< why the last one could not be opened; empty otherwise
};
/// Offers them, and generated ones, in a window of its own. `open` turns false when it is closed;
/// without that it cannot be.
std::optional<Choice> draw_start_panel(const StartOffer& offer, bool* open);

/// A picture that a person wants to save.
struct PicturePlan {
  bool open = false;  ///< whether the panel is shown
  int width = 0;      ///< in pixels, both at least 1
  int height = 0;
};
/// Asks for its size, in a window of its own; true when the file is to be asked for.
bool draw_picture_panel(PicturePlan& plan);

/// Pictures from all around that a person wants to save.
struct TurntablePlan {
  PicturePlan picture;  ///< each of them
  int count = 120;      ///< at least 1
  double per_second = 30.0;
};
/// Asks for these, in a window of its own; true when the file is to be asked for.
bool draw_turntable_panel(TurntablePlan& plan);
/// How far it is, in a window that nothing else can be done beside; true when it is given up.
/// Without one, none is shown: to be called in every frame.
bool draw_turntable_progress(const TurntableRecording* recording);

/// Asks whether to write over a file, in a window of its own; nothing until the person says.
std::optional<bool> draw_overwrite_panel(const std::filesystem::path& file);

/// What becomes of an edit that is not saved.
enum class UnsavedChoice { save, discard, cancel };
/// Asks, in a window of its own.
std::optional<UnsavedChoice> draw_unsaved_panel(const std::string& name);

/// What to do with an edit that a crash interrupted.
struct InterruptedChoice {
  std::size_t edit = 0;  ///< which one
  enum class What { restore, discard, later } what = What::later;
};
/// Asks, in a window of its own.
std::optional<InterruptedChoice> draw_interrupted_panel(std::span<const InterruptedEdit> edits);

/// Meshes and recipes worth opening, of those that tools/demo and tools/test fetched: looked for in
/// build/models and tools/recipes here, and beside the program's build folder.
std::vector<std::filesystem::path> find_samples();

}  // namespace lapwing::viewer
