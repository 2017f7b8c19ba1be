#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "editing/edit_surface.h"
#include "editing/surface_picker.h"
#include "editing/view_frame.h"
#include "lapwing/render/pose_measure.h"

namespace lapwing::viewer {

/// The colours in a file, for the edited surface and for the results of steps, as far as these have
/// the file's attributes.
struct FileColoring {
  std::shared_ptr<const FilePaint> file;  ///< null for none
  std::shared_ptr<const Mesh> opened;     ///< before any step, with attributes, seams not joined
};

/// An edit on the screen: the surface on the device, its positions and colours, and what is under a
/// pixel. It is made again on the device when the triangles change. The device must have finished
/// drawing it then, and whenever it changes.
///
/// Shows the first of these that applies: a preview, while there is one; the opened mesh, after
/// `show_before`; a drag, while it is followed; the surface of the state.
class ShownSurface {
 public:
  /// `opened` is the mesh before any step, to compare with.
  explicit ShownSurface(std::shared_ptr<const Mesh> opened, FileColoring coloring = {});

  /// Release everything on the device, or make it there. In between only `take` may be called.
  void release_device();
  void use_device(std::shared_ptr<gpu::Context> context);

  /// Sets the edited state; ends drag and preview. Returns true if the surface has other triangles
  /// or positions than before.
  bool take(const AppState& state);
  /// Shows the surface without a drag.
  void show_still();

  /// Follows the handles' motions by the response that the worker has. Does nothing while it has
  /// none.
  void follow(const Preparation& preparation, std::span<const Eigen::Affine3d> motions);
  /// Sets the pose from which it follows: of the state's region, or null for the rest shape. It
  /// stays until another pose is set or the surface is placed.
  void follow_from(std::shared_ptr<const DragState> pose);
  const std::shared_ptr<const DragState>& pose() const { return device_->surface.pose(); }
  bool follows() const { return follows_; }
  /// The motions of the handles while it follows them; empty otherwise.
  const std::vector<Eigen::Affine3d>& followed() const { return followed_; }

  /// Shows the result of an operation until `end_preview` or the next `take`. `classes`, one per
  /// vertex, determine its colours. Without them it has those of the selection, if the triangles
  /// are the same.
  void show_preview(std::shared_ptr<const Mesh> preview, std::vector<VertexClass> classes = {});
  /// The same with other positions only: one upload.
  void show_preview(const Positions& positions);
  void end_preview();
  bool previews() const { return preview_ != nullptr; }

  /// Whether the opened mesh is shown, to compare with.
  bool shows_before() const { return before_; }
  void show_before(bool before);

  /// Returns whether the triangles on the screen are the state's, so that tools can choose there.
  bool has_triangles_of_state() const { return device_->topology.get() == &now_->topology(); }
  const Topology& topology() const { return *device_->topology; }

  /// Colours the selection. Other triangles show no selection.
  void set_classes(std::vector<VertexClass> classes);
  /// Returns whether the triangles have changed since.
  bool needs_classes() const { return needs_classes_; }

  /// Returns whether the file has colours for what is on the screen.
  bool has_file_colors() const { return device_->surface.paint().has_file_colors(); }

  /// Colours by a difference from the opened mesh, or by regions without `measure`.
  void color_by(std::optional<PoseMeasure> measure) { measure_ = measure; }
  /// Returns whether it has the triangles of the opened mesh.
  bool is_comparable() const { return device_->topology.get() == &opened_->topology(); }
  /// Returns whether the paint's numbers are those of the surface; false while it follows a drag.
  bool is_measured() const;
  void renew_measure();
  const ScalarRange& measure_range() const { return measure_range_; }

  /// Returns what is visible at `pixel`, also in a drag; nothing beside the surface. Neither draws
  /// nor waits for the device. At most linear in the triangles.
  std::optional<SurfacePoint> pick(const ViewFrame& view, const Eigen::Vector2d& pixel);
  /// Returns the positions on the screen, including a drag under way. Valid until anything changes.
  const Positions& positions_on_screen();
  /// Waits for the device if the picture must be drawn. Valid until the next call of this or
  /// `pick`.
  TrianglePicture picture(const ViewFrame& view);

  const EditSurface& device() const { return device_->surface; }
  /// The positions of the state, or of a preview with the same triangles. Leaves out a drag under
  /// way.
  const Positions& positions() const {
    return previews() && has_triangles_of_state() ? preview_positions_ : positions_;
  }
  /// Returns the bounds of all that it shows without a drag, and of the opened mesh.
  Bounds bounds() const;
  const Bounds& opened_bounds() const { return opened_bounds_; }

 private:
  void make(const Mesh& mesh);
  const Mesh& with_attributes(const Mesh& mesh) const;
  void put(const Mesh& mesh, const Positions& positions);
  const Positions& still_positions() const;

  // Everything in device memory, except the worker's.
  struct OnDevice {
    OnDevice(const Mesh& mesh, const std::shared_ptr<gpu::Context>& context)
        : topology(mesh.shared_topology()), picker(*context), surface(context, mesh) {}

    std::shared_ptr<const Topology> topology;
    SurfacePicker picker;
    EditSurface surface;
  };

  std::shared_ptr<gpu::Context> context_;
  std::optional<OnDevice> device_;
  std::shared_ptr<const Mesh> opened_;
  FileColoring coloring_;
  Bounds opened_bounds_;

  // The surface of the state, and its positions.
  std::shared_ptr<const Mesh> now_;
  std::shared_ptr<const Mesh> rest_;
  std::shared_ptr<const MovedVertices> settled_;
  Positions positions_;
  Bounds bounds_;

  std::shared_ptr<const Mesh> preview_;
  Positions preview_positions_;
  Bounds preview_bounds_;
  std::vector<VertexClass> preview_classes_;
  bool needs_classes_ = true;
  bool before_ = false;
  bool follows_ = false;
  std::vector<Eigen::Affine3d> followed_;
  std::vector<Eigen::Affine3d> dragged_by_;  // motions that the device shows, of a drag or after it
  Positions dragged_positions_;              // by those motions, for this version of the surface:
  std::optional<std::uint64_t> dragged_version_;

  std::optional<PoseMeasure> measure_;
  std::optional<PoseMeasure> measured_;  // by the paint's numbers, for this version of the surface:
  std::uint64_t measured_version_ = 0;
  ScalarRange measure_range_;
};

}  // namespace lapwing::viewer
