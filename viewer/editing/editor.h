#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "editing/shown_carried.h"
#include "editing/shown_surface.h"
#include "editing/tool_table.h"
#include "state/message.h"
#include "work/attachment_follower.h"
#include "work/certificate_words.h"
#include "work/edit_session.h"

namespace lapwing::viewer {

/// The edit with which an Editor starts.
struct EditStart {
  History history;
  std::shared_ptr<const Mesh> opened;            ///< the mesh before all steps, for `show_before`
  std::optional<MeshStamp> file;                 ///< see EditSession
  std::optional<InterruptedEdit> restored;       ///< the edit from which `history` was restored
  std::filesystem::path journals;                ///< see EditSession
  std::shared_ptr<const FilePaint> colors = {};  ///< null if the file has no colours
};

/// Returns whether the command makes the settled surface the rest shape first (`apply`).
bool commits(const Command& command);

/// Edits one mesh in a window. Owns the session, the active tool and the displayed surface. An
/// action that fails reports its error to `say` and changes nothing.
class Editor {
 public:
  /// The worker creates its kernels on `context`. It calls `wake` when its status has changed.
  Editor(EditStart start, const std::shared_ptr<gpu::Context>& context, Say say,
         std::function<void()> wake);
  Editor(const Editor&) = delete;
  Editor& operator=(const Editor&) = delete;

  struct Handled {
    bool taken = false;    ///< no other receiver should act on the event
    bool changed = false;  ///< the view must be drawn again
  };
  Handled handle(const InputEvent& event, const ViewFrame& view);
  /// Handles a click that no tool took: selects the handle there, and reports what is there.
  void click(const Eigen::Vector2d& pixel, const ViewFrame& view);

  /// Releases everything on the device, after it was lost.
  void release_device();
  /// Makes it again on `context`. Nothing else may be called in between.
  void use_device(const std::shared_ptr<gpu::Context>& context);

  /// Takes the results of the background threads and moves the surface with the drag. Call this
  /// once per frame, before drawing and after the device has finished the last frame.
  void update();

  /// Returns true while the last edit is settling, or while postponed actions wait for it.
  bool waits() const;
  bool has_postponed() const { return !postponed_.empty(); }
  /// Runs `act` once the edit has settled, after all actions that were postponed earlier. While
  /// actions are postponed, `undo` only discards them. `redo` and `go_to` discard them and then
  /// change the state.
  void postpone(std::function<void()> act);

  /// Carries out the command and returns whether it succeeded. If `commits(command)` is true, the
  /// last edit must settle first, so the command is postponed until then.
  bool perform(const Command& command, Joining joining = Joining::own_step);
  void undo();
  void redo();
  void go_to(std::size_t steps);
  void continue_with(History history);
  void settle();  ///< computes the result of the moves
  /// Carries out a whole step in the background (EditSession). `update` takes its result.
  void carry_out(const Step& step);
  void replace_step(std::size_t index, const Step& step);
  /// Does the same with files that follow the surface from the open step on.
  void carry_along(const std::vector<std::filesystem::path>& files);
  /// Calls `change`, which modifies the session, and updates the view. Returns false if `change`
  /// throws an Error.
  bool attempt(const std::function<void()>& change);
  /// Makes the result the rest shape and clears the selection, once the last edit has settled.
  void new_edit();
  /// Calls `change` (for example `grow`) with the active part, and performs the returned command.
  using PartChange = std::function<std::optional<Command>(const AppState&, const Part&)>;
  void change_part(const PartChange& change);
  /// Finds the symmetry plane of the surface and turns mirroring on in this plane. Reports how far
  /// the surface is from its mirror image.
  void mirror_by_shape();
  /// Returns whether handles have vertices outside the ROI.
  bool handles_leave_roi() const;
  /// Adds these vertices and some rings of neighbours to the ROI. If the handles are inside, adds a
  /// margin of half as many vertices as the ROI has. The handles keep their moves.
  void enlarge_roi();
  /// Carries out the advice of a warning.
  void carry_out(Remedy remedy);

  const EditSession& session() const { return *session_; }
  EditSession& session() { return *session_; }
  const AppState& state() const { return session_->state(); }

  /// The active tool.
  const SceneTool& tool() const { return *tool_; }
  bool has_in_hand(const SceneTool& tool) const { return tool_ == &tool; }
  /// Its row of `tool_rows`; null for a panel's tool.
  const ToolRow* row() const { return row_; }
  void take(const ToolRow& row);
  /// Activates the action's tool. Returns whether it has one.
  bool take(Action action);
  /// Activates a tool that a panel owns. The tool must stay alive until `give_back`.
  void lend(SceneTool& tool);
  void give_back(const SceneTool& tool);
  /// The part that the tools choose.
  const Part& part() const { return part_; }
  void choose(const Part& part);
  /// Returns whether the active tool chooses vertices of `part()`.
  bool chooses_parts() const {
    return has_in_hand(tools_.disk) || has_in_hand(tools_.loop) || has_in_hand(tools_.paint);
  }
  /// Calls `choose`, and activates the disk unless the active tool chooses parts.
  void begin_choosing(const Part& part);
  /// Goes on to the usual next part: from the ROI to a handle, from there to moving it.
  void go_on();
  /// Adds all vertices to the part that the active tool chooses. If the tool chooses no part, adds
  /// them to the ROI. After the ROI, the user chooses the handle.
  void choose_all();

  GrabTool& grab_tool() { return tools_.grab; }
  PaintTool& paint_tool() { return tools_.paint; }
  StiffnessPaint& stiffness_tool() { return tools_.stiffness; }
  const GizmoTool& gizmo_tool() const { return tools_.gizmo; }
  const RulerTool& ruler_tool() const { return tools_.ruler; }
  bool has_gizmo() const { return has_in_hand(tools_.gizmo) && handle_ < handle_count(); }
  void show_gizmo(GizmoMode mode) { tools_.gizmo.show(mode); }
  const GizmoChoices& gizmo_choices() const { return tools_.gizmo.choices(); }
  void set_gizmo_choices(const GizmoChoices& choices) { tools_.gizmo.set_choices(choices); }
  /// Report the new setting.
  void take_next_gizmo_axes();
  void toggle_sticking();
  /// Lets the next click on the surface set the pivot of the handle. Escape cancels this.
  void begin_picking_pivot() { picks_pivot_ = !is_dragging(); }
  bool picks_pivot() const { return picks_pivot_; }
  std::size_t handle() const { return handle_; }  ///< the handle to move
  void set_gizmo_keys(GizmoKeys keys) { gizmo_keys_ = keys; }
  bool is_dragging() const;
  /// Returns the number of vertices of `part`, including those that are being chosen.
  std::size_t count(const Part& part) const;

  /// Returns true if nothing holds the surface against its only handle (`moves_as_a_whole`).
  bool moves_as_a_whole() const { return moves_as_a_whole_; }
  /// The problems of the result that is shown.
  const std::vector<CertificateWarning>& warnings() const { return warnings_; }

  /// Returns whether the surface settles during a drag, within the time budget of a frame. This
  /// requires the user's preference (`wants_to_settle_while_dragging`) and `parameters.settle`.
  bool settles_while_dragging() const { return continuous_ && state().parameters.settle; }
  bool wants_to_settle_while_dragging() const { return continuous_; }
  void set_settles_while_dragging(bool on) { continuous_ = on; }
  /// Returns whether the displayed surface starts from a settled pose of the current drag.
  bool shows_live_result() const;

  const ShownSurface& shown() const { return shown_; }
  ShownSurface& shown() { return shown_; }
  void show_before(bool before);
  void set_feature_angle(double degrees);  ///< does nothing during a drag
  /// Highlights vertices, until something is edited.
  void point_at(std::vector<Index> vertices) { pointed_at_ = std::move(vertices); }
  const std::vector<Index>& pointed_at() const { return pointed_at_; }

  const EditSurface& surface() const { return shown_.device(); }
  const ShownCarried& carried() const { return carried_; }
  /// As in ShownSurface.
  const Positions& positions() const { return shown_.positions(); }
  /// Returns the bounds of everything that is drawn.
  Bounds bounds() const;
  /// Returns the vertices of the active part, or those of the ROI if the active part is empty.
  std::vector<Index> selected() const;
  const char* hint() const;  ///< what to do next

 private:
  ToolScene scene(const ViewFrame& view, const Projection& projection);
  ToolAnswer send_to_gizmo(const InputEvent& event, const Projection& projection);
  bool pick_pivot(const InputEvent& event, const ViewFrame& view);
  std::optional<SurfacePoint> pick_beside_roi(const Ray& ray) const;
  void return_to_triangles_of_state();
  Handled act_on(const ToolAnswer& answer, Joining joining, bool may_change);
  void begin_drag();
  void take_hold(const ToolAnswer& answer, const Eigen::Vector2d& pixel,
                 const Projection& projection);
  void say_what_was_let_go(std::size_t handles_before);
  void choose_elsewhere(const InputEvent& event, const ViewFrame& view);
  bool pull_handle(const InputEvent& event, const ViewFrame& view, const Projection& projection);
  bool begins_elsewhere(const Command& command) const;
  bool postpones(const InputEvent& event, const ViewFrame& view);
  bool postpones(const ToolAnswer& answer, const InputEvent& event, const ViewFrame& view);
  void run_postponed();
  void give_up_postponed();
  void state_changed(bool by_result = false);
  std::size_t handle_count() const { return state().selection.handles.size(); }

  void take_step();
  void step_through_history(const std::function<void()>& change);
  void follow_hand();
  void hold_pose();
  void turn_free_handles();
  Eigen::Affine3d pose_map(std::size_t handle) const;
  Eigen::Vector3d centroid_of(std::size_t handle) const;
  void limit_lead();
  void settle_live();
  void follow_carried();
  void show_carried();
  void show_classes();  ///< if they have changed

  Say say_;
  ShownSurface shown_;
  ShownCarried carried_;
  AttachmentFollower attachment_follower_;
  std::unique_ptr<EditSession> session_;

  Tools tools_;
  SceneTool* tool_ = &tools_.grab;
  const ToolRow* row_ = &tool_rows().front();
  Part part_;
  std::size_t handle_ = 0;
  GizmoKeys gizmo_keys_ = GizmoKeys::blender;
  bool picks_pivot_ = false;

  bool moves_as_a_whole_ = false;
  std::vector<CertificateWarning> warnings_;
  std::vector<Eigen::Affine3d> motions_;
  double longest_lead_ = 0.0;
  std::vector<std::size_t> dragged_;
  std::vector<HandleMove> live_moves_;
  std::optional<LiveResult> live_;                        // last result of a drag
  std::optional<std::vector<HandleMove>> resting_moves_;  // requested while the mouse rests
  std::shared_ptr<const DragState> dragged_from_;         // pose before the drag
  bool classes_are_old_ = true;
  bool continuous_ = true;
  std::vector<std::function<void()>> postponed_;  // to run once the edit has settled, in order
  bool postpones_drag_ = false;                   // the button of a postponed press is still down
  // `done()` of the history after a choice that a tool may still resize.
  std::optional<std::size_t> sizable_at_;
  bool drag_is_of_last_step_ = false;  // the press that drags has also chosen the handle
  std::vector<Index> pointed_at_;
};

}  // namespace lapwing::viewer
