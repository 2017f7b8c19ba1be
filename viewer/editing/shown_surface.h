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

/// What colours the surface of an edit, and whatever comes of it with other triangles, as far as
/// that has attributes of the file.
struct FileColoring {
  std::shared_ptr<const FilePaint> file;  ///< null for none
  std::shared_ptr<const Mesh> opened;     ///< before any step and with attributes, seams not joined
};

/// What of an edit is on the screen: the surface on the device, where its vertices are, what its
/// colours say, and what is under a pixel. Made anew on the device when the triangles are others;
/// the device must be done with what was drawn then, and whenever it changes.
///
/// In this order it shows: a preview, while there is one; the mesh as it was opened, if
/// `show_before` says so; a drag, while it is followed; the surface as the state knows it.
class ShownSurface {
 public:
  /// `opened` is the mesh before any step, to compare with.
  explicit ShownSurface(std::shared_ptr<const Mesh> opened, FileColoring coloring = {});

  /// Lets all go that is on the device, or makes it there. Between them only `take` may be called.
  void release_device();
  void use_device(std::shared_ptr<gpu::Context> context);

  /// What is edited now; ends drag and preview. True where the
  /// surface has other triangles than before, or is elsewhere.
  bool take(const AppState& state);
  /// Puts the surface where it is known to be.
  void show_still();

  /// Lets it follow the handles' motions as far as the worker is. Nothing while that has nothing.
  void follow(const Preparation& preparation, std::span<const Eigen::Affine3d> motions);
  /// What it follows them from: a pose of the region that the state chooses, null for the rest
  /// shape. Until another one, or until the surface is put somewhere.
  void follow_from(std::shared_ptr<const DragState> pose);
  const std::shared_ptr<const DragState>& pose() const { return device_->surface.pose(); }
  bool follows() const { return follows_; }
  /// Of the handles, where it follows those; empty otherwise.
  const std::vector<Eigen::Affine3d>& followed() const { return followed_; }

  /// What would come of an operation, until it ends, or the next `take`. `classes`, one per vertex
  /// of it, are its colours; without them it has those of what is chosen, if the triangles are the
  /// same.
  void show_preview(std::shared_ptr<const Mesh> preview, std::vector<VertexClass> classes = {});
  /// The same with other positions alone: one upload.
  void show_preview(const Positions& positions);
  void end_preview();
  bool previews() const { return preview_ != nullptr; }

  /// The mesh as it was opened, to compare with.
  bool shows_before() const { return before_; }
  void show_before(bool before);

  /// Whether the triangles on the screen are those of the state, so that tools can choose there.
  bool has_triangles_of_state() const { return device_->topology.get() == &now_->topology(); }
  const Topology& topology() const { return *device_->topology; }

  /// Colours what is chosen; for triangles of other numbers nothing is.
  void set_classes(std::vector<VertexClass> classes);
  /// Whether other triangles have come since.
  bool needs_classes() const { return needs_classes_; }

  /// Whether the file gives what is on the screen a colour.
  bool has_file_colors() const { return device_->surface.paint().has_file_colors(); }

  /// Colours by how the surface differs from the one opened; nothing: by regions.
  void color_by(std::optional<PoseMeasure> measure) { measure_ = measure; }
  /// Whether it has the triangles of the one opened.
  bool is_comparable() const { return device_->topology.get() == &opened_->topology(); }
  /// Whether the paint's numbers are those of the surface; not while it follows a drag.
  bool is_measured() const;
  void renew_measure();
  const ScalarRange& measure_range() const { return measure_range_; }

  /// What shows at `pixel`, in a drag, too; nothing beside the surface. Neither draws nor waits for
  /// the device. Linear in the triangles, at most.
  std::optional<SurfacePoint> pick(const ViewFrame& view, const Eigen::Vector2d& pixel);
  /// Where the vertices show, a drag under way included. Until anything changes.
  const Positions& positions_on_screen();
  /// Waits for the device where it is to be drawn. Valid until the next call of this or `pick`.
  TrianglePicture picture(const ViewFrame& view);

  const EditSurface& device() const { return device_->surface; }
  /// Where the vertices of the state are, or a preview of the same triangles puts them, but for a
  /// drag under way.
  const Positions& positions() const {
    return previews() && has_triangles_of_state() ? preview_positions_ : positions_;
  }
  /// Of all that it shows without a drag, and of the mesh as it was opened.
  Bounds bounds() const;
  const Bounds& opened_bounds() const { return opened_bounds_; }

 private:
  void make(const Mesh& mesh);
  const Mesh& with_attributes(const Mesh& mesh) const;
  void put(const Mesh& mesh, const Positions& positions);
  const Positions& still_positions() const;

  // All that is in device memory but for the worker's.
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

  // What the state says, and where that takes the vertices.
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
  std::vector<Eigen::Affine3d> dragged_by_;  // what the device shows of a drag, ended or not
  Positions dragged_positions_;              // by those, where the surface has this version:
  std::optional<std::uint64_t> dragged_version_;

  std::optional<PoseMeasure> measure_;
  std::optional<PoseMeasure> measured_;  // what the paint's numbers are, of that surface:
  std::uint64_t measured_version_ = 0;
  ScalarRange measure_range_;
};

}  // namespace lapwing::viewer
