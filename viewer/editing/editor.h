#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "editing/edit_surface.h"
#include "editing/surface_picker.h"
#include "editing/view_frame.h"
#include "lapwing/render/pose_measure.h"
#include "tools/certificate_words.h"
#include "tools/disk_tool.h"
#include "tools/edit_session.h"
#include "tools/gizmo_tool.h"
#include "tools/loop_tool.h"
#include "tools/paint_tool.h"

namespace lapwing::viewer {

/// What the left button does on the surface.
enum class EditTool { move, disk, loop, brush, lasso, box };

/// An edit to begin with.
struct EditStart {
  History history;
  std::shared_ptr<const Mesh> opened;       ///< before any step, to compare with
  std::optional<MeshStamp> file;            ///< EditSession's
  std::optional<InterruptedEdit> restored;  ///< what the history continues
  std::filesystem::path journals;           ///< EditSession's
};

/// One mesh being edited in a window: its session, the tool in hand, and its surface on the device.
/// Events go in; what to draw comes out. Panels perform commands. What does not work is said to
/// `say`, and nothing has changed then.
class Editor {
 public:
  using Say = std::function<void(std::string)>;

  /// `kernels` must outlive the editor; the worker gets kernels of its own on their context and
  /// calls `wake` when it has news.
  Editor(EditStart start, VulkanKernels& kernels, Say say, std::function<void()> wake);

  struct Handled {
    bool taken = false;    ///< nobody else should act on the event
    bool changed = false;  ///< the picture has to be drawn again
  };
  Handled handle(const InputEvent& event, const ViewFrame& view);
  /// A click that no tool took: on a handle it takes hold of that. Says what is there.
  void click(const Eigen::Vector2d& pixel, const ViewFrame& view);

  /// The device was lost: lets all go that was made on it.
  void release_device();
  /// And makes it anew, on the context of `kernels`, where the edit was. Nothing else may be called
  /// between.
  void use_device(VulkanKernels& kernels);

  /// Once a frame, before it is drawn and after the device is done with the last one: takes what
  /// the worker has, and lets the surface follow the hand.
  void update();

  void perform(const Command& command);
  void undo();
  void redo();
  void go_to(std::size_t steps);
  void continue_with(History history);
  void settle();  ///< the moves that have no result yet
  void grow();
  void shrink();
  void invert();
  void remove_handle();
  /// Handles may not leave the ROI: it takes them in, with some rings around for the surface to
  /// follow.
  bool handles_leave_roi() const;
  void enlarge_roi();

  const EditSession& session() const { return *session_; }
  EditSession& session() { return *session_; }
  const AppState& state() const { return session_->state(); }

  EditTool tool() const { return tool_; }
  void take(EditTool tool);
  /// What the tools choose.
  const Part& part() const { return part_; }
  void choose(const Part& part);
  /// To what usually comes next: from the ROI to a handle, from there to moving it.
  void go_on();

  PaintTool& paint_tool() { return paint_; }
  const PaintTool& paint_tool() const { return paint_; }
  const LoopTool& loop_tool() const { return loop_; }
  const GizmoTool& gizmo_tool() const { return gizmo_; }
  bool has_gizmo() const { return tool_ == EditTool::move && handle_ < handle_count(); }
  void show_gizmo(GizmoMode mode) { gizmo_.show(mode); }
  GizmoScene gizmo_scene(const Projection& projection) const;
  std::size_t handle() const { return handle_; }  ///< the one that is moved
  void set_gizmo_keys(GizmoKeys keys) { gizmo_keys_ = keys; }
  bool is_dragging() const;
  /// How many vertices `part` has, what is being chosen for it included.
  std::size_t count(const Part& part) const;

  /// What is not as it should be with the result that is shown.
  const std::vector<CertificateWarning>& warnings() const { return warnings_; }

  bool settles_while_dragging() const { return continuous_; }
  void set_settles_while_dragging(bool on) { continuous_ = on; }

  /// Colours by how the surface differs from the one opened; nothing: by regions.
  void color_by(std::optional<PoseMeasure> measure) { measure_ = measure; }
  /// Whether the paint's numbers are those of the surface; not while it follows a drag.
  bool is_measured() const;
  const ScalarRange& measure_range() const { return measure_range_; }
  bool shows_before() const { return before_; }
  void show_before(bool before);
  /// Vertices that the picture points at, until something is edited.
  void point_at(std::vector<Index> vertices) { pointed_at_ = std::move(vertices); }
  const std::vector<Index>& pointed_at() const { return pointed_at_; }

  const EditSurface& surface() const { return device_->surface; }
  /// Where the vertices are, but for a drag under way.
  const Positions& positions() const { return positions_; }
  /// Of all that is drawn.
  Bounds bounds() const;
  /// Of what is chosen: the part, or else the ROI; of everything without.
  std::vector<Index> selected() const;
  const char* hint() const;  ///< what to do next

 private:
  void show_on(VulkanKernels& kernels);
  SelectScene select_scene(const ViewFrame& view, const Projection& projection);
  ToolAnswer send_to_gizmo(const InputEvent& event, const Projection& projection);
  ToolAnswer send_to_tool(const InputEvent& event, const SelectScene& scene);
  Handled carry_out(const ToolAnswer& answer);
  void step(const std::function<void()>& change);
  void after_choice(const Part& part);
  void state_changed();
  std::size_t handle_count() const { return state().selection.handles.size(); }

  void show_still();
  void follow_hand();
  bool follow_settled();
  void show_classes();  ///< where they have changed
  VertexSet live() const;
  void show_measure();

  Say say_;
  std::shared_ptr<const Mesh> opened_;
  Bounds opened_bounds_;
  // All that is in device memory but for the worker's.
  struct OnDevice {
    OnDevice(const Mesh& mesh, const Topology& topology, VulkanKernels& kernels)
        : picker(*kernels.context()), surface(mesh, topology, kernels) {}

    SurfacePicker picker;
    EditSurface surface;
  };
  std::optional<OnDevice> device_;
  std::unique_ptr<EditSession> session_;

  EditTool tool_ = EditTool::disk;
  Part part_;
  std::size_t handle_ = 0;
  DiskTool disk_;
  LoopTool loop_;
  PaintTool paint_;
  GizmoTool gizmo_;
  GizmoKeys gizmo_keys_ = GizmoKeys::blender;

  std::vector<CertificateWarning> warnings_;
  Positions positions_;
  Bounds bounds_;
  // What `positions_` was made of.
  std::shared_ptr<const Mesh> rest_;
  std::shared_ptr<const MovedVertices> settled_;
  bool following_ = false;  // the surface shows moves without a result
  std::vector<Eigen::Affine3d> motions_;
  std::vector<Eigen::Affine3d> followed_;
  std::vector<Move> live_moves_;
  bool classes_are_old_ = true;
  bool continuous_ = false;
  bool before_ = false;
  std::optional<PoseMeasure> measure_;
  std::optional<PoseMeasure> measured_;  // what the paint's numbers are, of that surface:
  std::uint64_t measured_version_ = 0;
  ScalarRange measure_range_;
  std::vector<Index> pointed_at_;
};

}  // namespace lapwing::viewer
