#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "lapwing/transplant/surface_snap.h"
#include "tools/gizmo_drag.h"
#include "tools/scene_tool.h"
#include "tools/transplant_draft.h"

namespace lapwing::viewer {

/// What a part is put on: a state that waits for no result.
struct TransplantHost {
  AppState state;
  std::shared_ptr<const SurfaceSnap> surface;
};

/// Puts a part on a surface. First it follows the cursor, standing on what is under it: [
/// and ], and the wheel with Control, make it larger and smaller, Shift and the wheel turn it. A
/// click sets it down; then a gizmo moves it, whose axes are the part's (W, E, Q; Control snaps),
/// and G takes it up again. Enter applies it, Escape gives up the drag, or all of it.
class PlaceTool final : public SceneTool {
 public:
  enum class Stage { empty, carried, set_down };

  /// Takes a part in hand; one that stands somewhere already is set down there.
  void begin(TransplantDraft draft, TransplantHost host);
  void end();
  /// The part follows the cursor again.
  void carry();
  /// It stays where it is, if it is anywhere.
  void set_down();

  ToolAnswer handle(const InputEvent& event, const ToolScene& scene) override;
  bool is_dragging() const override { return drag_.has_value(); }
  bool draws_preview() const override { return stage_ != Stage::empty; }
  const char* hint(const AppState& state, const Part& part) const override;

  Stage stage() const { return stage_; }
  const TransplantDraft& draft() const { return draft_; }
  TransplantDraft& draft() { return draft_; }
  const TransplantHost& host() const { return host_; }
  /// Another number whenever the part has come to another place.
  std::uint64_t version() const { return version_; }

  /// While it is set down.
  std::optional<Gizmo> gizmo() const;
  GizmoPart part() const { return drag_ ? drag_->part() : hovered_; }
  GizmoMode mode() const { return mode_; }
  void show(GizmoMode mode) {
    if (!drag_) mode_ = mode;
  }

  /// What a key asked for, once.
  enum class Wish { nothing, apply, give_up };
  Wish take_wish() { return std::exchange(wish_, Wish::nothing); }

  /// While it is carried snap its loop onto the surface.
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
  TransplantDraft way_;  // while it is carried: without snapping, which would wind it up
  std::optional<Eigen::Affine3d> taken_from_;  // where it was set down before
  std::uint64_t version_ = 0;
  Wish wish_ = Wish::nothing;

  GizmoMode mode_ = GizmoMode::translate;
  GizmoPart hovered_ = GizmoPart::none;
  std::optional<GizmoDrag> drag_;
  Eigen::Affine3d before_ = Eigen::Affine3d::Identity();  // the drag
  double snap_length_ = 1.0;
};

}  // namespace lapwing::viewer
