#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "editing/edit_surface.h"
#include "lapwing/render/camera.h"
#include "lapwing/render/id_picture.h"
#include "lapwing/render/pose_measure.h"
#include "tools/projection.h"
#include "tools/seen_vertices.h"

namespace lapwing::viewer {

/// The view of the surface: the camera with fitted near and far planes, and the picture's size and
/// density in pixels.
struct ViewFrame {
  Camera camera;
  Eigen::Vector2d size = Eigen::Vector2d::Ones();
  double pixels_per_point = 1.0;

  Projection projection() const {
    return {camera.projection(size.x() / size.y()) * camera.view(), size, pixels_per_point};
  }

  bool operator==(const ViewFrame&) const = default;
};

/// Renders an image of triangle indices and finds the triangle at a pixel. Renders the image again
/// only if the view or the surface has changed. The context must outlive the picker.
class SurfacePicker {
 public:
  explicit SurfacePicker(gpu::Context& context) : picture_(context) {}

  /// Returns whether the image is up to date.
  bool is_current(const EditSurface& surface, const ViewFrame& view) const {
    return view_ == view && version_ == surface.version();
  }

  /// Returns the triangle at `pixel` of the last image, or nullopt if there is none.
  std::optional<Index> triangle_at(const Eigen::Vector2d& pixel) const;

  /// Returns the triangle index at each pixel, valid until the next call. Waits for the device.
  TrianglePicture picture(const EditSurface& surface, const ViewFrame& view);

 private:
  IdPicture picture_;
  std::optional<ViewFrame> view_;  // of the last image
  std::uint64_t version_ = 0;      // of the surface in it
};

/// The colours in a file, for the edited surface and for the results of steps, as far as these have
/// the file's attributes.
struct FileColoring {
  std::shared_ptr<const FilePaint> file;  ///< null for none
  std::shared_ptr<const Mesh> opened;     ///< before any step, with attributes, seams not joined
};

/// Displays the surface of an edit. Holds the surface on the device with its positions and colours,
/// and finds the surface point under a pixel. Call non-const members only after the device has
/// finished drawing the surface.
///
/// Shows a preview if there is one. Otherwise it shows the opened mesh after `show_before`, the
/// surface during a drag, or the surface of the state.
class ShownSurface {
 public:
  /// `opened` is the mesh before all steps, for `show_before`.
  explicit ShownSurface(std::shared_ptr<const Mesh> opened, FileColoring coloring = {});

  /// Release everything on the device, or make it there. In between only `take` may be called.
  void release_device();
  void use_device(std::shared_ptr<gpu::Context> context);

  /// Sets the edited state; ends drag and preview. Returns true if the surface has other triangles
  /// or positions than before.
  bool take(const AppState& state);
  /// Shows the surface without a drag.
  void show_still();

  /// Moves the surface by the handles' motions, if `preparation` has a response.
  void follow(const Preparation& preparation, std::span<const Eigen::Affine3d> motions);
  /// Sets the pose from which `follow` starts. A null pose means the rest shape. The pose remains
  /// until EditSurface::place resets it.
  void follow_from(std::shared_ptr<const DragState> pose);
  const std::shared_ptr<const DragState>& pose() const { return device_->surface.pose(); }
  bool follows() const { return follows_; }
  /// The motions of the handles while it follows them; empty otherwise.
  const std::vector<Eigen::Affine3d>& followed() const { return followed_; }

  /// Shows the result of an operation until `end_preview` or the next `take`. `classes` has one
  /// entry per vertex, which determines its colour. If `classes` is empty and the triangles are
  /// those of the state, the selection determines the colours.
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

  /// Returns the opened mesh on the device, to draw it beside the edited surface. Uploads it unless
  /// it was already uploaded after the last `release_opened`.
  const EditSurface& opened_on_device();
  void release_opened() { opened_device_.reset(); }

  /// An edge is drawn sharp if the normals of its two faces differ by more than this angle
  /// (SplitNormals). A change of the angle rebuilds the surface on the device.
  double feature_angle() const { return feature_angle_; }
  void set_feature_angle(double degrees);

  /// Colours the selection. Other triangles show no selection.
  void set_classes(std::vector<VertexClass> classes);
  /// Returns whether the triangles have changed since.
  bool needs_classes() const { return needs_classes_; }

  /// Returns whether the file has colours for what is on the screen.
  bool has_file_colors() const { return device_->surface.paint().has_file_colors(); }

  /// Colours by a difference from the opened mesh, or by regions without `measure`.
  void color_by(std::optional<PoseMeasure> measure) { measure_ = measure; }
  /// Colours the preview by `numbers`, one per vertex, until it ends. If `numbers` is empty,
  /// restores the usual colours.
  void color_by(std::vector<float> numbers) { numbers_ = std::move(numbers); }
  bool has_numbers() const { return !numbers_.empty(); }
  /// Returns whether it has the triangles of the opened mesh.
  bool is_comparable() const { return device_->topology.get() == &opened_->topology(); }
  /// Returns whether the paint's numbers are those of the surface; false while it follows a drag.
  bool is_measured() const;
  void renew_measure();
  const ScalarRange& measure_range() const { return measure_range_; }

  /// Returns the visible surface point at `pixel`, or nullopt if the surface does not cover the
  /// pixel. Also works during a drag. Casts a ray on the CPU, so it does not wait for the device.
  std::optional<SurfacePoint> pick(const ViewFrame& view, const Eigen::Vector2d& pixel);
  /// Returns only its position.
  std::optional<Eigen::Vector3d> place_at(const ViewFrame& view, const Eigen::Vector2d& pixel) {
    const auto point = pick(view, pixel);
    return point ? std::optional(point->position) : std::nullopt;
  }
  /// Returns the displayed positions, also during a drag. Valid until the next non-const call.
  const Positions& positions_on_screen();
  /// Returns the triangle index at each pixel (SurfacePicker).
  TrianglePicture picture(const ViewFrame& view);

  const EditSurface& device() const { return device_->surface; }
  /// Returns the positions of the preview if it has the same triangles as the state, otherwise
  /// those of the state. A drag does not change them.
  const Positions& positions() const {
    return previews() && has_triangles_of_state() ? preview_positions_ : positions_;
  }
  /// Returns the bounds of the displayed surface without a drag and of the opened mesh.
  Bounds bounds() const;
  const Bounds& opened_bounds() const { return opened_bounds_; }
  /// Returns the bounds of the preview, or of the surface of the state.
  const Bounds& surface_bounds() const { return previews() ? preview_bounds_ : bounds_; }

 private:
  void make(const Mesh& mesh);
  const Mesh& with_attributes(const Mesh& mesh) const;
  void put(const Mesh& mesh, const Positions& positions);
  const Positions& still_positions() const;

  // Everything in device memory, except the worker's.
  struct OnDevice {
    OnDevice(const Mesh& mesh, const std::shared_ptr<gpu::Context>& context, double feature_angle)
        : topology(mesh.shared_topology()),
          picker(*context),
          surface(context, mesh, feature_angle) {}

    std::shared_ptr<const Topology> topology;
    SurfacePicker picker;
    EditSurface surface;
  };

  std::shared_ptr<gpu::Context> context_;
  std::optional<OnDevice> device_;
  std::optional<EditSurface> opened_device_;
  std::shared_ptr<const Mesh> opened_;
  FileColoring coloring_;
  Bounds opened_bounds_;
  double feature_angle_ = kFeatureAngleDegrees;

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
  std::vector<float> numbers_;  // of the preview
  bool shows_numbers_ = false;
  std::optional<PoseMeasure> measured_;  // by the paint's numbers, for this version of the surface:
  std::uint64_t measured_version_ = 0;
  ScalarRange measure_range_;
};

}  // namespace lapwing::viewer
