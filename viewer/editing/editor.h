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
#include "work/carry_follower.h"
#include "work/certificate_words.h"
#include "work/edit_session.h"

namespace lapwing::viewer {

/// An edit to begin with.
struct EditStart {
  History history;
  std::shared_ptr<const Mesh> opened;       ///< before any step, to compare with
  std::optional<MeshStamp> file;            ///< EditSession's
  std::optional<InterruptedEdit> restored;  ///< what the history continues
  std::filesystem::path journals;           ///< EditSession's
  std::shared_ptr<const FilePaint> colors;  ///< of the file of `opened`; null for none
};

/// Whether the command makes what has settled the rest shape of what comes then (`apply`).
bool commits(const Command& command);

/// One mesh being edited in a window: its session, the tool in hand, and what is shown of it.
/// Events go in; `shown` is what to draw. Panels perform commands and ask for steps. What does not
/// work is said to `say`, and nothing has changed then.
class Editor {
 public:
  /// The worker gets kernels of its own on `context` and
  /// calls `wake` when it has news.
  Editor(EditStart start, const std::shared_ptr<gpu::Context>& context, Say say,
         std::function<void()> wake);
  Editor(const Editor&) = delete;
  Editor& operator=(const Editor&) = delete;

  struct Handled {
    bool taken = false;    ///< nobody else should act on the event
    bool changed = false;  ///< the picture has to be drawn again
  };
  Handled handle(const InputEvent& event, const ViewFrame& view);
  /// A click that no tool took: on a handle it takes hold of that. Says what is there.
  void click(const Eigen::Vector2d& pixel, const ViewFrame& view);

  /// The device was lost: lets all go that was made on it.
  void release_device();
  /// And makes it anew, on `context`, where the edit was. Nothing else may be called
  /// between.
  void use_device(const std::shared_ptr<gpu::Context>& context);

  /// Once a frame, before it is drawn and after the device is done with the last one: takes what
  /// the worker has, and lets the surface follow the hand.
  void update();

  /// Whether what a person does next may have to wait: the last edit still settles, or something
  /// waits for that already.
  bool waits() const;
  bool has_postponed() const { return !postponed_.empty(); }
  /// Does `act` once it has settled, after what waits already. Undo gives up all that waits, and
  /// nothing else then; so does whatever else goes through the history, on its way.
  void postpone(std::function<void()> act);

  /// Whether it was carried out. What chooses anew (`commits`) waits until what moved has settled.
  bool perform(const Command& command, Joining joining = Joining::own_step);
  void undo();
  void redo();
  void go_to(std::size_t steps);
  void continue_with(History history);
  void settle();  ///< the moves that have no result yet
  /// A whole step, beside the window (EditSession's): its result comes by itself.
  void carry_out(const Step& step);
  void replace_step(std::size_t index, const Step& step);
  /// Likewise files that follow the surface from the open step on.
  void carry_along(const std::vector<std::filesystem::path>& files);
  /// What a panel does to the session that may throw: said, and shown anew.
  bool attempt(const std::function<void()>& change);
  /// What was done stays and nothing is chosen any more, once what moved has settled.
  void new_edit();
  void select_all();
  void clear();
  void grow();
  void shrink();
  void invert();
  void remove_handle();
  /// Mirrors in the plane that the shape has, and says how symmetric it is. A second or less.
  void mirror_by_shape();
  /// Handles may not leave the ROI: it takes them in, with some rings around for the surface to
  /// follow.
  bool handles_leave_roi() const;
  void enlarge_roi();

  const EditSession& session() const { return *session_; }
  EditSession& session() { return *session_; }
  const AppState& state() const { return session_->state(); }

  /// The tool in hand.
  const SceneTool& tool() const { return *tool_; }
  bool has_in_hand(const SceneTool& tool) const { return tool_ == &tool; }
  /// Its row of `tool_rows`; null for a panel's tool.
  const ToolRow* row() const { return row_; }
  void take(const ToolRow& row);
  /// The tool that the action takes; true if there is one.
  bool take(Action action);
  /// Takes a panel's tool in hand, or gives it back if it is. It must live until then.
  void lend(SceneTool& tool);
  void give_back(const SceneTool& tool);
  /// What the tools choose.
  const Part& part() const { return part_; }
  void choose(const Part& part);
  /// To what usually comes next: from the ROI to a handle, from there to moving it.
  void go_on();

  PaintTool& paint_tool() { return tools_.paint; }
  const GizmoTool& gizmo_tool() const { return tools_.gizmo; }
  const RulerTool& ruler_tool() const { return tools_.ruler; }
  bool has_gizmo() const { return has_in_hand(tools_.gizmo) && handle_ < handle_count(); }
  void show_gizmo(GizmoMode mode) { tools_.gizmo.show(mode); }
  const GizmoChoices& gizmo_choices() const { return tools_.gizmo.choices(); }
  void set_gizmo_choices(const GizmoChoices& choices) { tools_.gizmo.set_choices(choices); }
  /// Say what they come to.
  void take_next_gizmo_axes();
  void toggle_sticking();
  /// The next click on the surface says what the handle turns about; Escape leaves it as it is.
  void begin_picking_pivot() { picks_pivot_ = !is_dragging(); }
  bool picks_pivot() const { return picks_pivot_; }
  std::size_t handle() const { return handle_; }  ///< the one that is moved
  void set_gizmo_keys(GizmoKeys keys) { gizmo_keys_ = keys; }
  bool is_dragging() const;
  /// How many vertices `part` has, what is being chosen for it included.
  std::size_t count(const Part& part) const;

  /// What is not as it should be with the result that is shown.
  const std::vector<CertificateWarning>& warnings() const { return warnings_; }

  /// Whether a drag shows what it will come to, settled on the way as far as there is time; by
  /// default. Without settling in the parameters there is nothing to settle.
  bool settles_while_dragging() const { return continuous_ && state().parameters.settle; }
  /// Whether it would, with settling in the parameters.
  bool wants_to_settle_while_dragging() const { return continuous_; }
  void set_settles_while_dragging(bool on) { continuous_ = on; }
  /// Whether the surface goes on from what has settled of a drag.
  bool shows_live_result() const;

  const ShownSurface& shown() const { return shown_; }
  ShownSurface& shown() { return shown_; }
  void show_before(bool before);
  /// Vertices that the picture points at, until something is edited.
  void point_at(std::vector<Index> vertices) { pointed_at_ = std::move(vertices); }
  const std::vector<Index>& pointed_at() const { return pointed_at_; }

  const EditSurface& surface() const { return shown_.device(); }
  /// What is carried along with it. In a drag it is where it was a frame or two before, while that
  /// is found beside the window (CarryFollower).
  const ShownCarried& carried() const { return carried_; }
  /// ShownSurface's.
  const Positions& positions() const { return shown_.positions(); }
  /// Of all that is drawn.
  Bounds bounds() const;
  /// Of what is chosen: the part, or else the ROI; of everything without.
  std::vector<Index> selected() const;
  const char* hint() const;  ///< what to do next

 private:
  ToolScene scene(const ViewFrame& view, const Projection& projection);
  ToolAnswer send_to_gizmo(const InputEvent& event, const Projection& projection);
  bool pick_pivot(const InputEvent& event, const ViewFrame& view);
  std::optional<SurfacePoint> pick_beside_roi(const SightLine& ray) const;
  void return_to_triangles_of_state();
  Handled act_on(const ToolAnswer& answer, Joining joining);
  Handled act_on(const ToolAnswer& answer, Joining joining, bool may_change);
  void begin_drag();
  void take_hold(const ToolAnswer& answer, const Eigen::Vector2d& pixel,
                 const Projection& projection);
  void after_choice(const Part& part);
  void say_what_was_let_go(std::size_t handles_before);
  void choose_elsewhere(const InputEvent& event, const ViewFrame& view);
  bool pull_handle(const InputEvent& event, const ViewFrame& view, const Projection& projection);
  bool begins_elsewhere(const Command& command) const;
  bool postpones(const InputEvent& event, const ViewFrame& view);
  bool postpones(const ToolAnswer& answer, const InputEvent& event, const ViewFrame& view);
  void take_up_postponed();
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
  void stay_near_pose();
  void settle_live();
  void follow_carried();
  void show_carried();
  void show_classes();  ///< where they have changed

  Say say_;
  ShownSurface shown_;
  ShownCarried carried_;
  CarryFollower carry_follower_;
  std::unique_ptr<EditSession> session_;

  Tools tools_;
  SceneTool* tool_ = &tools_.disk;
  const ToolRow* row_ = &tool_rows().front();
  Part part_;
  std::size_t handle_ = 0;
  GizmoKeys gizmo_keys_ = GizmoKeys::blender;
  bool picks_pivot_ = false;

  std::vector<CertificateWarning> warnings_;
  std::vector<Eigen::Affine3d> motions_;
  double longest_lead_ = 0.0;
  std::vector<std::size_t> dragged_;
  std::vector<HandleMove> live_moves_;
  std::optional<LiveResult> live_;                   // the last one of a drag
  std::optional<std::vector<HandleMove>> resting_moves_;  // those asked for of a hand that rests
  std::shared_ptr<const DragState> dragged_from_;         // before any
  bool classes_are_old_ = true;
  bool continuous_ = true;
  std::vector<std::function<void()>> postponed_;  // until what moved has settled, in order
  bool postpones_drag_ = false;                   // the button that began what waits is still down
  // How many steps were done after a choice that may still be sized as one step with it.
  std::optional<std::size_t> sizable_at_;
  bool drag_is_of_last_step_ = false;  // what is dragged was made by the press that holds it
  std::vector<Index> pointed_at_;
};

}  // namespace lapwing::viewer
