#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "editing/active_tool.h"
#include "editing/shown_carried.h"
#include "editing/shown_surface.h"
#include "state/message.h"
#include "work/attachment_follower.h"

namespace lapwing::viewer {

/// Shows an edit: the surface with the colours of the selection, the carried objects, and the
/// highlighted vertices. A LiveDrag moves the surface, and tools and panels show previews on it.
class SurfaceView {
 public:
  /// `opened` is the mesh before all steps. `wake` is called on another thread when the places of
  /// carried objects are computed.
  SurfaceView(const EditSession& session, const ActiveTool& active,
              std::shared_ptr<const Mesh> opened, FileColoring coloring, Say say,
              std::function<void()> wake);

  /// Release all device resources, and create them again. Between these calls, only `take_state`
  /// may be called.
  void release_device();
  void use_device(const std::shared_ptr<gpu::Context>& context);

  /// Takes the state of the session, and ends drag and preview. Returns true if the triangles or
  /// positions of the surface have changed.
  bool take_state();
  /// Moves the carried objects with a drag and updates the colours. Call this once per frame, after
  /// LiveDrag::update.
  void update();

  const ShownSurface& shown() const { return shown_; }
  ShownSurface& shown() { return shown_; }
  const EditSurface& device() const { return shown_.device(); }
  const ShownCarried& carried() const { return carried_; }
  /// As in ShownSurface.
  const Positions& positions() const { return shown_.positions(); }
  /// Returns the bounds of everything that is drawn, except a surface that a drag has moved.
  Bounds bounds() const { return carried_.united_with(shown_.bounds()); }

  /// Shows the opened mesh, or the edit again. This and the next function do nothing during a drag.
  void show_before(bool before);
  void set_feature_angle(double degrees);
  /// Call this when the active tool has selected other vertices during a stroke.
  void renew_classes() { classes_are_old_ = true; }
  /// Highlights vertices until the next edit.
  void point_at(std::vector<Index> vertices) { pointed_at_ = std::move(vertices); }
  const std::vector<Index>& pointed_at() const { return pointed_at_; }

 private:
  void show_carried();
  void follow_carried();
  void show_classes();  ///< if they have changed

  const EditSession& session_;
  const ActiveTool& active_;
  Say say_;
  ShownSurface shown_;
  ShownCarried carried_;
  AttachmentFollower follower_;
  std::vector<Index> pointed_at_;
  bool classes_are_old_ = true;
  const SceneTool* classes_of_ = nullptr;  // the tool whose colours are shown
};

}  // namespace lapwing::viewer
