#include "tools/disk_tool.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>

#include "lapwing/region/geodesic.h"
#include "tools/hidden_place.h"
#include "tools/selection_edits.h"

namespace lapwing::viewer {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// The cursor moves less than this during a click.
constexpr double kClickPt = 4.0;

// Radius of a disk that is clicked before any was dragged, as a share of the mesh's diagonal.
constexpr double kFirstRadius = 0.1;

constexpr double kFactorOfSize = 1.1;

// Returns by how many steps the event resizes a disk; 0 if it does not.
double steps_of(const InputEvent& event) {
  if (event.kind == InputKind::scroll && event.modifiers == kSizes) return event.scroll;
  if (event.kind != InputKind::key || event.modifiers != Modifiers{}) return 0.0;
  return event.key == ']' ? 1.0 : event.key == '[' ? -1.0 : 0.0;
}

// Returns the barycentric coordinates of `p`; 1/3 each if the triangle has no area.
Vector3d barycentric(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& p) {
  const Vector3d normal = (b - a).cross(c - a);
  const double squared = normal.squaredNorm();
  if (squared == 0.0) return Vector3d::Constant(1.0 / 3.0);
  const double u = (c - b).cross(p - b).dot(normal) / squared;
  const double v = (a - c).cross(p - c).dot(normal) / squared;
  return {u, v, 1.0 - u - v};
}

}  // namespace

ToolAnswer DiskTool::handle(const InputEvent& event, const ToolScene& scene) {
  renew_grips(scene);
  const auto hovered =
      std::exchange(hovered_, dragging_ ? hovered_ : grip_at_cursor(event.position, scene));
  hover_changed_ = hovered_ != hovered;
  if (event.kind == InputKind::press && event.button == MouseButton::left) {
    if (hovered_) {
      take_grip(event, scene);
      return ToolAnswer::only_taken();
    }
    const auto pick = scene.pick(event.position);
    if (!pick) return ToolAnswer::passed_on();
    begin(*pick, event, scene);
    return ToolAnswer::only_taken();
  }
  if (const double steps = steps_of(event); steps != 0.0 && center_ != kNoIndex) {
    return resized(steps);
  }
  if (!dragging_) return ToolAnswer::passed_on();
  return drag(event, scene);
}

ToolAnswer DiskTool::drag(const InputEvent& event, const ToolScene& scene) {
  if (event.kind == InputKind::key && event.key == kEscape) {
    give_up();
    return ToolAnswer::only_taken();
  }
  const bool releases = event.kind == InputKind::release && event.button == MouseButton::left;
  if (event.kind != InputKind::move && !releases) return ToolAnswer::passed_on();
  const double way = (event.position - pressed_).norm();
  follows_hand_ = follows_hand_ || way > scene.projection.in_pixels(kClickPt);
  if (follows_hand_ && event.kind == InputKind::move) radius_ = radius_at(event.position, scene);
  if (!releases) return ToolAnswer::only_taken();
  dragging_ = false;
  if (!size_before_) {
    has_moved_ = follows_hand_;
    return chosen();
  }
  size_before_.reset();
  if (!follows_hand_) return ToolAnswer::only_taken();
  ToolAnswer answer = chosen();
  answer.resizes = true;
  return answer;
}

// A disk that a grip was resizing gets its old radius back.
void DiskTool::give_up() {
  if (!size_before_) return reset();
  dragging_ = false;
  radius_ = *std::exchange(size_before_, std::nullopt);
}

bool DiskTool::is_at_grip(const Vector2d& pixel, const ToolScene& scene) {
  renew_grips(scene);
  return !dragging_ && grip_at_cursor(pixel, scene).has_value();
}

// Ignores grips that the surface hides.
std::optional<std::size_t> DiskTool::grip_at_cursor(const Vector2d& pixel,
                                                    const ToolScene& scene) const {
  const auto at = grip_at(grips_, pixel, scene.projection);
  if (!at || is_hidden(grips_[*at].position, pixel, scene)) return std::nullopt;
  return at;
}

// Shows grips only if the surface is settled and the state still has this disk. It may have been
// undone, painted on or replaced.
void DiskTool::renew_grips(const ToolScene& scene) {
  if (dragging_ || center_ == kNoIndex || needs_settling(scene.state) ||
      !is_chosen(scene.state.selection)) {
    grips_.clear();
    grips_radius_ = 0.0;
  } else if (grips_radius_ != radius_) {
    grips_ = rim_grips(surface_of(scene.state)->topology(), scene.positions, distances_, center_,
                       radius_);
    grips_radius_ = radius_;
  }
}

bool DiskTool::is_chosen(const EditSelection& selection) const {
  const bool is_handle = part_.role == Part::Role::handle;
  if (is_handle && part_.handle >= selection.handles.size()) return false;
  const ChosenRegion& region = is_handle                        ? selection.handles[part_.handle]
                               : part_.role == Part::Role::belt ? selection.belt
                                                                : selection.roi;
  const auto* disk = std::get_if<GeodesicDisk>(&region.made.form);
  return disk != nullptr && *disk == GeodesicDisk{center_, radius_} && region.added.empty() &&
         region.removed.empty();
}

void DiskTool::take_grip(const InputEvent& event, const ToolScene& scene) {
  dragging_ = true;
  follows_hand_ = false;
  size_before_ = radius_;
  pressed_ = event.position;
  start_ = scene.projection.to_pixel(scene.positions[center_]).value_or(event.position);
}

void DiskTool::begin(const SurfacePoint& pick, const InputEvent& event, const ToolScene& scene) {
  dragging_ = true;
  follows_hand_ = has_moved_ = false;
  size_before_.reset();
  part_ = scene.part;
  center_ = pick.vertex;
  start_ = pressed_ = event.position;
  if (radius_ == 0.0) radius_ = kFirstRadius * bounds_of(scene.positions).diagonal();
  distances_ =
      geodesic_distances(surface_of(scene.state)->topology(), scene.positions, {&center_, 1});
}

// Returns the geodesic distance if the cursor is on the surface, else the distance across the view.
double DiskTool::radius_at(const Vector2d& pixel, const ToolScene& scene) const {
  if (const auto pick = scene.pick(pixel)) {
    const Triangle& t = surface_of(scene.state)->topology().triangles[pick->triangle];
    const Vector3d shares = barycentric(scene.positions[t[0]], scene.positions[t[1]],
                                        scene.positions[t[2]], pick->position);
    const double distance =
        shares.dot(Vector3d(distances_[t[0]], distances_[t[1]], distances_[t[2]]));
    if (std::isfinite(distance) && distance > 0.0) return distance;
  }
  return (pixel - start_).norm() * scene.projection.length_of_pixel(scene.positions[center_]);
}

ToolAnswer DiskTool::chosen() const {
  return {.taken = true, .command = Choose{part_, {GeodesicDisk{center_, radius_}, "disk"}}};
}

ToolAnswer DiskTool::resized(double steps) {
  radius_ *= std::pow(kFactorOfSize, steps);
  if (dragging_) return ToolAnswer::only_taken();
  ToolAnswer answer = chosen();
  answer.resizes = true;
  return answer;
}

const char* DiskTool::hint(const AppState& state, const Part& part) const {
  if (hovered_) return "drag the rim's dot to size the disk";
  if (may_change_choice() && !vertices_of(state.selection, part).empty()) {
    return "Ctrl + wheel, or a dot of its rim, sizes the disk; Enter accepts it";
  }
  return of_part(part, "drag from the middle of the region to edit to its rim",
                 "choose the belt, between ROI and handle",
                 "drag from the middle of a handle in the ROI to its rim");
}

ToolMarks DiskTool::marks() const {
  ToolMarks marks;
  marks.grips = grips_;
  marks.grip = hovered_;
  return marks;
}

VertexSet DiskTool::live() const {
  VertexSet vertices;
  if (!dragging_) return vertices;
  for (Index v = 0; v < distances_.size(); ++v) {
    if (distances_[v] <= radius_) vertices.push_back(v);
  }
  return vertices;
}

}  // namespace lapwing::viewer
