#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "navigation/camera_controller.h"
#include "ui/panels.h"

namespace lapwing::viewer {

/// Largest share of the window's width that the sidebar covers. In the smallest window, the names
/// of the tabs need this share.
inline constexpr double kMostOfSidebar = 0.6;

/// How far the panels cover the window, in ImGui's units. The code that draws a panel sets its
/// size.
struct PanelSizes {
  bool are_shown = true;
  double sidebar = 0.0;      ///< width
  double covered_top = 0.0;  ///< height of menu and tools, while the panels are shown
  double toolbar = 0.0;      ///< height
  double guide = 0.0;        ///< height
  double banner = 0.0;       ///< height
};

/// The 3D view of the open document: its camera, the scene under the panels, and the line that
/// compares it with the original. Passes the mouse to the source of a coat or mix, the axis gizmo,
/// the line, the editor's tools and the camera, in this order.
class Viewport {
 public:
  Viewport(const std::unique_ptr<Document>& document, const Preferences& preferences,
           const DisplayChoices& display)
      : document_(document), preferences_(preferences), display_(display) {}

  PanelSizes panels;

  /// Shows all of a document that was just opened.
  void begin();
  void resize(const Eigen::Vector2d& size, double pixels_per_point);
  /// Call this once per frame, after the document is updated.
  void update();
  Scene scene();
  /// Draws the marks over the scene and under the panels.
  void draw_marks();

  /// Returns whether the view must be drawn again; nullopt for a key that no tool has taken.
  std::optional<bool> handle(const InputEvent& event);
  /// Carries out an action of the camera or the line. Returns false for others.
  bool perform(Action action);
  bool has_slider() const { return slider_.has_value(); }
  void set_up_axis(UpAxis axis);

  const CameraController& camera() const { return camera_; }
  /// Returns the camera with fitted near and far planes. This and the next two functions need a
  /// document.
  ViewFrame frame() const;
  SurfaceStyle style() const;
  std::optional<GroundGrid> grid() const;

  /// Returns the part of the window that the panels leave free, in ImGui's units.
  PictureArea free_area() const;
  double sidebar_width() const;  ///< likewise

  /// Frames vertices and highlights them, until `look_back`.
  void show_vertices(const std::vector<Index>& vertices);
  bool shows_vertices() const { return view_before_.has_value(); }
  void look_back();
  /// Show the defects that the banner lists, or restore the earlier view.
  void look_at_places();
  void look_back_from_places();

 private:
  double pixels_per_unit() const;
  double sidebar_pixels() const;
  double covered_share() const;
  void set_camera(Camera camera);
  CameraSubject subject();
  std::optional<PictureArea> source_area() const;
  std::optional<double> slider_line() const;
  std::optional<Eigen::Vector2d> axis_gizmo_center() const;
  std::optional<bool> handle_source(const InputEvent& event);
  bool handle_axis_gizmo(const InputEvent& event);
  bool handle_slider(const InputEvent& event);
  bool may_begin(const InputEvent& event) const;
  void toggle_slider();
  void zoom_by(double factor, const Eigen::Vector2d& cursor);
  void frame_all();
  void frame_vertices(std::span<const Index> vertices);
  void frame_points(std::span<const Eigen::Vector3d> points);

  const std::unique_ptr<Document>& document_;
  const Preferences& preferences_;
  const DisplayChoices& display_;
  CameraController camera_;
  EditMarks marks_;
  std::optional<Camera> view_before_;  // before vertices were shown
  Camera camera_before_;               // before the doctor showed its defects
  // Position of the slider's line in the area that the panels do not cover, from 0 at its left edge
  // to 1 at its right edge.
  std::optional<double> slider_;
  bool on_slider_ = false;      // its line is being dragged
  bool on_axis_gizmo_ = false;  // the motion began on the axis gizmo
  bool shows_source_ = false;   // beside the mesh
  Bounds surface_;              // of the last frame
};

}  // namespace lapwing::viewer
