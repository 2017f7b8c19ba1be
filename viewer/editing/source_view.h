#pragma once

#include <memory>
#include <optional>

#include "editing/editor.h"
#include "navigation/camera_controller.h"
#include "tools/disk_tool.h"

namespace lapwing::viewer {

/// What the left button does on the source.
enum class SourceTool { disk, point };

/// The mesh from which an operation takes, shown beside the edited mesh, with a separate camera, a
/// patch that is chosen by a disk, and points to pick. Pixels start at the upper left corner of its
/// part of the window.
class SourceView {
 public:
  /// Shows all of `mesh` with `up_axis` up.
  SourceView(std::shared_ptr<const Mesh> mesh, UpAxis up_axis,
             const std::shared_ptr<gpu::Context>& context);

  void release_device() { shown_.release_device(); }
  void use_device(const std::shared_ptr<gpu::Context>& context);

  const AppState& state() const { return state_; }
  const ChosenRegion& patch() const { return state_.selection.roi; }
  /// Throws what `apply` throws.
  void choose_patch(const RegionSpec& region);

  SourceTool tool() const { return tool_; }
  void take(SourceTool tool) { tool_ = tool; }

  /// Sets its size in pixels, and the pixels per point (Projection).
  void resize(const Eigen::Vector2d& size, double pixels_per_point);
  Handled handle(const InputEvent& event, const Keymap& keymap);
  /// Returns whether a button that was pressed on it is still down.
  bool holds_mouse() const { return camera_.is_moving() || disk_.is_dragging(); }
  /// Returns the last picked point. The next call returns nothing until another point is picked.
  std::optional<SurfacePoint> take_point() { return std::exchange(point_, std::nullopt); }

  /// Call this once per frame, before drawing.
  void update();

  ViewFrame view_frame() const;
  const ShownSurface& shown() const { return shown_; }

 private:
  ToolAnswer choose(const InputEvent& event);

  AppState state_;
  ShownSurface shown_;
  CameraController camera_;
  bool is_framed_ = false;
  SourceTool tool_ = SourceTool::disk;
  DiskTool disk_;
  std::optional<SurfacePoint> point_;
  bool classes_are_old_ = true;
};

}  // namespace lapwing::viewer
