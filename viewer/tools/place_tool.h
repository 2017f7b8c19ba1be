#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "lapwing/transplant/surface_placement.h"
#include "tools/gizmo_drag.h"
#include "tools/scene_tool.h"
#include "tools/transplant_draft.h"

namespace lapwing::viewer {

/// The surface that a part is placed on. No result is pending for `state`.
struct TransplantHost {
  AppState state;
  std::shared_ptr<const SurfaceSnap> surface;
};

/// Places a part on a surface. At first the part follows the cursor on the surface. The keys [ and
/// ] or Control + wheel scale the part, and Shift + wheel rotates it. A click fixes it in place.
/// The user can then adjust it with a gizmo (W, E, Q; Control snaps), whose axes are those of the
/// part, or press G to move it with the cursor again. Enter applies the transplant. Escape cancels
/// the drag, or the placement if there is no drag.
class PlaceTool final : public SceneTool {
 public:
  enum class Stage { empty, carried, set_down };

  /// Starts to place a part. A draft that already stands on the surface is set down there.
  void begin(TransplantDraft draft, TransplantHost host);
  void end();
  /// Makes the part follow the cursor again.
  void carry();
  /// Leaves the part where it is, if it stands on the surface.
  void set_down();

  ToolAnswer handle(const InputEvent& event, const ToolScene& scene) override;
  bool is_dragging() const override { return drag_.has_value(); }
  bool draws_preview() const override { return stage_ != Stage::empty; }
  const char* hint(const AppState& state, const Part& part) const override;

  Stage stage() const { return stage_; }
  const TransplantDraft& draft() const { return draft_; }
  TransplantDraft& draft() { return draft_; }
  const TransplantHost& host() const { return host_; }
  /// Changes whenever the placement changes.
  std::uint64_t version() const { return version_; }

  /// Returns the gizmo of a part that is set down, else nullopt.
  std::optional<Gizmo> gizmo() const;
  GizmoPart part() const { return drag_ ? drag_->part() : hovered_; }
  GizmoMode mode() const { return mode_; }
  void show(GizmoMode mode) {
    if (!drag_) mode_ = mode;
  }

  /// The request of a key. `take_wish` returns it once.
  enum class Wish { nothing, apply, give_up };
  Wish take_wish() { return std::exchange(wish_, Wish::nothing); }

  /// Snap the loop of a carried part to the surface.
  bool snaps = true;

 private:
  ToolAnswer handle_key(const InputEvent& event);
  ToolAnswer handle_scroll(const InputEvent& event);
  ToolAnswer carry_on(const InputEvent& event, const Projection& projection);
  ToolAnswer adjust(const InputEvent& event, const Projection& projection);
  Eigen::Affine3d snapped(const Eigen::Vector3d& point) const;
  bool follow(const Eigen::Vector2d& pixel, const Projection& projection);
  template <class Change>
  void change(const Change& change);
  void place(const Eigen::Affine3d& placement);
  void escape();

  Stage stage_ = Stage::empty;
  TransplantDraft draft_;
  TransplantHost host_;
  TransplantDraft way_;  // the carried part before snapping, which would accumulate
  std::optional<Eigen::Affine3d> taken_from_;  // placement before it was picked up
  std::uint64_t version_ = 0;
  Wish wish_ = Wish::nothing;

  GizmoMode mode_ = GizmoMode::translate;
  GizmoPart hovered_ = GizmoPart::none;
  std::optional<GizmoDrag> drag_;
  Eigen::Affine3d before_ = Eigen::Affine3d::Identity();  // placement before the drag
  double snap_length_ = 1.0;
};

}  // namespace lapwing::viewer
