#include "tools/place_tool.h"

#include <cmath>
#include <utility>

namespace lapwing::viewer {
namespace {

using Eigen::Affine3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kFactorPerNotch = 1.1;
constexpr double kDegreesPerNotch = 5.0;
// Radius over which the surface normal is averaged, in radii of the part's loop.
constexpr double kLookedAt = 0.7;
// Farthest that snapping may move a part, in radii of its loop.
constexpr double kFarthestSlide = 0.3;

// Returns axes whose z is `normal` and whose x and y turn with the part.
Eigen::Matrix3d axes_of(const Affine3d& placement, const Vector3d& normal) {
  Vector3d aside = Vector3d::Zero();
  for (Eigen::Index k = 0; k < 3; ++k) {
    const Vector3d column = placement.linear().col(k);
    const Vector3d across = (column - column.dot(normal) * normal) / column.norm();
    if (across.norm() > aside.norm() + 1e-3) aside = across;
  }
  Eigen::Matrix3d axes;
  axes.col(0) = aside.normalized();
  axes.col(1) = normal.cross(axes.col(0));
  axes.col(2) = normal;
  return axes;
}

}  // namespace

void PlaceTool::begin(TransplantDraft draft, TransplantHost host) {
  end();
  draft_ = std::move(draft);
  host_ = std::move(host);
  ++version_;
  if (draft_.stands) {
    stage_ = Stage::set_down;
  } else {
    carry();
  }
}

void PlaceTool::end() {
  stage_ = Stage::empty;
  draft_ = {};
  host_ = {};
  way_ = {};
  taken_from_.reset();
  drag_.reset();
  hovered_ = GizmoPart::none;
  wish_ = Wish::nothing;
}

void PlaceTool::carry() {
  if (draft_.part == nullptr || drag_) return;
  if (stage_ == Stage::set_down) taken_from_ = draft_.placement;
  stage_ = Stage::carried;
  way_ = draft_;
}

void PlaceTool::set_down() {
  if (stage_ != Stage::carried || !draft_.stands) return;
  stage_ = Stage::set_down;
  taken_from_.reset();
  hovered_ = GizmoPart::none;
}

const char* PlaceTool::hint(const AppState&, const Part&) const {
  switch (stage_) {
    case Stage::carried:
      return "Click to place the part. Ctrl+wheel scales it, Shift+wheel rotates it.";
    case Stage::set_down:
      return "Drag the gizmo (W, E, Q). G picks the part up again, Enter applies, Escape cancels.";
    case Stage::empty:
      break;
  }
  return "Choose a part.";
}

std::optional<Gizmo> PlaceTool::gizmo() const {
  if (stage_ != Stage::set_down) return {};
  const LoopFrame frame = draft_.frame();
  return Gizmo{mode_, frame.center, axes_of(draft_.placement, frame.normal)};
}

ToolAnswer PlaceTool::handle(const InputEvent& event, const ToolScene& scene) {
  if (stage_ == Stage::empty || event.kind == InputKind::text) return ToolAnswer::passed_on();
  if (event.kind == InputKind::key) return handle_key(event);
  if (event.kind == InputKind::scroll) return handle_scroll(event);
  return stage_ == Stage::carried ? carry_on(event, scene.projection)
                                  : adjust(event, scene.projection);
}

ToolAnswer PlaceTool::handle_key(const InputEvent& event) {
  if (event.modifiers.control || event.modifiers.alt) return ToolAnswer::passed_on();
  const bool down = stage_ == Stage::set_down;
  if (event.key == kEscape) {
    escape();
  } else if (event.key == kEnter) {
    if (down) wish_ = Wish::apply;
    set_down();
  } else if (event.key == '[' || event.key == ']') {
    const double factor = event.key == ']' ? kFactorPerNotch : 1.0 / kFactorPerNotch;
    change([&](TransplantDraft& draft) { draft.scale_by(factor); });
  } else if (down && event.key == 'G') {
    carry();
  } else if (const auto mode = mode_of_key(event.key); down && mode) {
    show(*mode);
  } else {
    return ToolAnswer::passed_on();
  }
  return ToolAnswer::only_taken();
}

void PlaceTool::escape() {
  if (std::exchange(drag_, {})) return place(before_);
  if (!taken_from_) {
    wish_ = Wish::give_up;
    return;
  }
  place(*std::exchange(taken_from_, {}));
  stage_ = Stage::set_down;
}

ToolAnswer PlaceTool::handle_scroll(const InputEvent& event) {
  if (event.modifiers == Modifiers{.shift = true}) {
    change([&](TransplantDraft& draft) { draft.turn_by(kDegreesPerNotch * event.scroll); });
  } else if (event.modifiers == kSizes && stage_ == Stage::carried) {
    change(
        [&](TransplantDraft& draft) { draft.scale_by(std::pow(kFactorPerNotch, event.scroll)); });
  } else {
    return ToolAnswer::passed_on();
  }
  return ToolAnswer::only_taken();
}

// Applies `change` to the draft. While the part follows the cursor, also applies it to `way_`, from
// which the next cursor event computes the draft.
template <class Change>
void PlaceTool::change(const Change& change) {
  if (drag_) return;
  if (stage_ == Stage::carried) change(way_);
  change(draft_);
  ++version_;
}

void PlaceTool::place(const Affine3d& placement) {
  draft_.placement = placement;
  ++version_;
}

// Snaps the part to the surface, unless it would slide away from the cursor.
Affine3d PlaceTool::snapped(const Vector3d& point) const {
  if (!snaps) return way_.placement;
  TransplantDraft there = way_;
  there.placement = host_.surface->snap(way_.placement, way_.part->loop, "the part");
  const LoopFrame frame = there.frame();
  return (frame.center - point).norm() < kFarthestSlide * frame.radius ? there.placement
                                                                       : way_.placement;
}

bool PlaceTool::follow(const Vector2d& pixel, const Projection& projection) {
  const Positions& positions = host_.state.rest->positions;
  const Topology& topology = surface_of(host_.state)->topology();
  const auto point = pick_surface(topology, positions, projection.ray_through(pixel));
  if (!point) return false;
  const double around = kLookedAt * way_.frame().radius;
  way_.stand_at(point->position, normal_around(*point, around, topology, positions));
  draft_.stands = true;
  place(snapped(point->position));
  return true;
}

ToolAnswer PlaceTool::carry_on(const InputEvent& event, const Projection& projection) {
  const bool presses = event.kind == InputKind::press;
  if (presses ? event.button != MouseButton::left : event.kind != InputKind::move) {
    return ToolAnswer::passed_on();
  }
  // A press beside the surface turns the view.
  if (!follow(event.position, projection)) return ToolAnswer::passed_on();
  if (presses) set_down();
  return ToolAnswer::only_taken();
}

ToolAnswer PlaceTool::adjust(const InputEvent& event, const Projection& projection) {
  if (!drag_) {
    const Gizmo there = *gizmo();
    const GizmoPart before = std::exchange(hovered_, hit_gizmo(there, projection, event.position));
    const bool begins = event.kind == InputKind::press && event.button == MouseButton::left &&
                        hovered_ != GizmoPart::none;
    if (begins) {
      before_ = draft_.placement;
      snap_length_ = snap_length(there, projection);
      drag_.emplace(there, hovered_, projection, event.position);
    }
    return begins || (event.kind == InputKind::move && hovered_ != before)
               ? ToolAnswer::only_taken()
               : ToolAnswer::passed_on();
  }
  if (event.kind == InputKind::press && event.button == MouseButton::right) {
    escape();
    return ToolAnswer::only_taken();
  }
  drag_->move_to(event.position);
  std::optional<SnapSteps> steps;
  if (event.modifiers.control) steps = SnapSteps{.length = snap_length_};
  place(drag_->motion(drag_->amount(steps)) * before_);
  if (event.kind == InputKind::release && event.button == MouseButton::left) drag_.reset();
  return ToolAnswer::only_taken();
}

}  // namespace lapwing::viewer
