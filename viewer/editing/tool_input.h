#pragma once

#include <optional>

#include "editing/action_queue.h"

namespace lapwing::viewer {

/// Sends the events of the view to the gizmo and the active tool, and carries out their answers. An
/// event waits for postponed actions that came before it.
class ToolInput {
 public:
  ToolInput(const EditSession& session, ActiveTool& active, SurfaceView& view, LiveDrag& drag,
            ActionQueue& actions, Say say);

  Handled handle(const InputEvent& event, const ViewFrame& view);
  /// Handles a click that no tool took: selects the handle there, and reports what is there.
  void click(const Eigen::Vector2d& pixel, const ViewFrame& view);
  void set_gizmo_keys(GizmoKeys keys) { gizmo_keys_ = keys; }

  /// Lets the next click on the surface set the pivot of the handle. Escape cancels this.
  void begin_picking_pivot() { picks_pivot_ = !active_.is_dragging(); }
  bool picks_pivot() const { return picks_pivot_; }
  const char* hint() const;  ///< what to do next

 private:
  const AppState& state() const { return session_.state(); }
  ToolScene scene(const ViewFrame& view, const Projection& projection);
  ToolScene gizmo_scene(const Projection& projection) const;
  std::optional<Handled> handle_by_gizmo(const InputEvent& event, const ViewFrame& view,
                                         const Projection& projection);
  ToolAnswer send_to_gizmo(const InputEvent& event, const Projection& projection);
  bool pull_handle(const InputEvent& event, const ViewFrame& view, const Projection& projection);
  std::optional<SurfacePoint> pick_beside_roi(const Ray& ray) const;
  bool pick_pivot(const InputEvent& event, const ViewFrame& view);
  void return_to_triangles_of_state();
  void choose_elsewhere(const InputEvent& event, const ViewFrame& view);
  bool begins_elsewhere(const Command& command) const;
  Handled act_on(const ToolAnswer& answer, Joining joining, bool may_change);
  void take_hold(const ToolAnswer& answer, const Eigen::Vector2d& pixel,
                 const Projection& projection);
  bool postpones(const InputEvent& event, const ViewFrame& view);
  bool postpones(const ToolAnswer& answer, const InputEvent& event, const ViewFrame& view);

  const EditSession& session_;
  ActiveTool& active_;
  SurfaceView& view_;
  LiveDrag& drag_;
  ActionQueue& actions_;
  Say say_;
  GizmoKeys gizmo_keys_ = GizmoKeys::blender;
  bool picks_pivot_ = false;
};

}  // namespace lapwing::viewer
