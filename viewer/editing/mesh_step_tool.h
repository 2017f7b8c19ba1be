#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "editing/editor.h"
#include "lapwing/doctor/check.h"
#include "work/step_preview.h"

namespace lapwing::viewer {

/// The settings of the commands of the Mesh tab.
struct MeshStepDrafts {
  RemeshRequest remesh{.region = {AllVertices{}}};
  bool only_region = false;  ///< whether `remesh` remeshes the ROI only
  DecimateRequest decimate;
  SubdivideRequest subdivide;
  FillRequest fill;
};

/// Lets the user remesh, decimate and subdivide the mesh, and fill its holes. Computes and shows a
/// preview, and applies it as one step. Also checks the surface when its triangles change.
class MeshStepTool {
 public:
  /// `report` is the report about `mesh`.
  MeshStepTool(std::shared_ptr<const Mesh> mesh, CheckReport report,
               const std::shared_ptr<gpu::Context>& context, std::function<void()> wake);

  MeshStepDrafts drafts;

  /// Requests a preview of `step` on the current surface, once the last edit has settled.
  void preview(const Step& step);
  /// Returns the step of the preview, or null if none is open.
  const Step* step() const { return step_ ? &*step_ : nullptr; }
  bool is_open() const { return step_.has_value(); }
  /// Returns whether the view shows the result of the step.
  bool has_picture() const { return shown_; }
  /// Discards the preview.
  void close(Editor& editor);
  /// Discards the preview, but leaves the view as it is, because something else is shown there.
  void give_way();
  /// Adds the previewed result to the history as a step. Does nothing before it is computed.
  void apply(Editor& editor);

  const StepPreview& result() const { return preview_; }

  /// Returns the report about the surface, or null while it is being checked. Moving vertices does
  /// not renew the report.
  const CheckReport* report() const { return report_ ? &*report_ : nullptr; }

  /// Call this once per frame, after the editor's update. Closes the preview if the user edits the
  /// mesh or `others_preview` is true.
  void update(Editor& editor, bool others_preview);

  void release_device();
  void use_device(const std::shared_ptr<gpu::Context>& context);

 private:
  void update_report(const Editor& editor);
  void start(const Editor& editor);

  std::optional<Step> step_;
  // The surface on which the step was started; null before.
  std::shared_ptr<const Mesh> rest_;
  std::shared_ptr<const MovedVertices> settled_;
  bool shown_ = false;
  StepPreview preview_;
  std::shared_ptr<const Mesh> checked_;
  std::optional<CheckReport> report_;
  Job<CheckReport> checking_;
};

}  // namespace lapwing::viewer
