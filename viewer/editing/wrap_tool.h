#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "editing/detail_transfer_tool.h"
#include "editing/editor.h"
#include "editing/source_view.h"
#include "work/step_preview.h"

namespace lapwing::viewer {

/// The settings of a wrap that are not landmarks.
struct WrapSettings {
  // All as in WrapStep.
  bool aligned = false;
  bool hard = false;
  std::optional<MirrorSpec> mirror = {};
  bool detail = false;
};

/// Lets the user wrap the mesh, a template, onto a scan. Holds a view of the scan, the landmarks
/// that the user picks in pairs, and the result until it is applied. Reports errors to `say`.
class WrapTool {
 public:
  WrapTool(UpAxis up_axis, const std::shared_ptr<gpu::Context>& context, Say say,
           std::function<void()> wake);

  /// `open_scan` begins a wrap onto another scan, without landmarks, or with those with which the
  /// last wrap onto this scan was closed. `take_up` opens the recipe step at `index` for editing;
  /// if that step is not a wrap, it returns false and changes nothing.
  void open_scan(Editor& editor, const std::filesystem::path& scan);
  bool take_up(Editor& editor, std::size_t index);
  /// Closes the wrap and discards its result.
  void close(Editor& editor);
  /// Stops the computation if it is running. Otherwise ends an incomplete pair or move of a point,
  /// or picking. If none of these is in progress, closes the wrap.
  void cancel(Editor& editor);
  bool is_open() const { return !scan_.empty(); }
  /// Returns the index of the step that is being edited again, if there is one.
  std::optional<std::size_t> taken_up() const { return taken_up_; }

  const std::filesystem::path& scan() const { return scan_; }
  /// Returns the view of the scan, or null while the scan is read and if it cannot be read.
  SourceView* view() { return view_.get(); }
  const SourceView* view() const { return view_.get(); }
  bool is_reading() const { return is_reading_; }

  /// Returns the landmarks as points of the template with their positions on the scan.
  const std::vector<Target>& landmarks() const { return edits_[edit_].points; }
  void remove(std::size_t landmark);
  /// The next click on the template or on the scan moves that point of the landmark.
  void move(Editor& editor, std::size_t landmark);
  std::optional<std::size_t> moved() const { return moved_; }
  /// Undoes or redoes a change of the landmarks. Returns false if there is none.
  bool undo();
  bool redo();
  /// Replaces the landmarks, as one change that can be undone. If `file` contains only the points
  /// on the template, `scan_file` contains those on the scan.
  void load_landmarks(std::filesystem::path file, std::filesystem::path scan_file = {});
  void save_landmarks(const std::filesystem::path& file);

  bool picks() const { return picks_; }
  void pick(bool on, Editor& editor);
  /// Takes the points that were clicked. Call this after each event.
  void take_points(Editor& editor);
  /// Return the points of an incomplete pair.
  std::optional<Index> picked_on_template() const { return point_tool_.picked; }
  const std::optional<Eigen::Vector3d>& picked_on_scan() const { return on_scan_; }

  WrapSettings settings;
  bool colors_by_distance = true;    ///< shows the distance of the result from the scan
  void show_colors(Editor& editor);  ///< call this after a change of `colors_by_distance`

  /// Computes the result in the background, once the last edit has settled.
  void wrap(const Editor& editor);
  const StepPreview& preview() const { return preview_; }
  /// Returns the report of the result, or null if there is no result.
  const WrapStepReport* report() const;
  /// Returns whether the result is that of the present landmarks and settings.
  bool is_current(const Editor& editor) const { return step_ == step(editor); }
  /// Returns the reaches of the springs as fractions of the template's diagonal.
  const std::vector<double>& reaches() const { return reaches_; }
  /// Adds the current result to the history as a step, or replaces the step that is edited again.
  void apply(Editor& editor);

  /// Call this once per frame, after the editor's update.
  void update(Editor& editor);

  void release_device();
  void use_device(const std::shared_ptr<gpu::Context>& context);

 private:
  struct Landmarks {
    std::vector<TargetRow> rows;
    std::vector<Target> points;  // of `rows`
  };
  // What a wrap that was closed leaves for the next one.
  struct Closed {
    std::filesystem::path scan;
    std::shared_ptr<const Mesh> of;  // the template
    std::vector<TargetRow> rows;
    WrapSettings settings;
  };

  const AppState& base(const Editor& editor) const { return start_ ? *start_ : editor.state(); }
  WrapStep step(const Editor& editor) const;
  void set_landmarks(const LandmarkSpec& spec);
  void set_landmarks(std::vector<TargetRow> rows);
  void restore_closed();
  void take_read();
  void drop_half_pair();
  void start(const Editor& editor);
  void drop_result(Editor& editor);
  void show(Editor& editor);

  UpAxis up_axis_;
  std::shared_ptr<gpu::Context> context_;
  Say say_;

  std::filesystem::path scan_;
  std::optional<std::size_t> taken_up_;
  std::optional<AppState> start_;  // before the step that is edited again
  std::shared_ptr<const Mesh> template_;
  std::unique_ptr<SourceView> view_;
  bool is_reading_ = false;
  LandmarkSpec to_load_;  // once the scan is read

  std::vector<Landmarks> edits_{1};  // the history of the landmarks
  std::size_t edit_ = 0;
  Closed closed_;
  bool picks_ = false;
  PointTool point_tool_;
  std::optional<Eigen::Vector3d> on_scan_;
  std::optional<std::size_t> moved_;

  std::optional<WrapStep> step_;  // of the result
  // The surface on which the computation began; null before that.
  std::shared_ptr<const Mesh> rest_;
  std::shared_ptr<const MovedVertices> settled_;
  std::vector<double> reaches_;
  StepPreview preview_;
  Job<std::shared_ptr<const Mesh>> reader_;
};

}  // namespace lapwing::viewer
