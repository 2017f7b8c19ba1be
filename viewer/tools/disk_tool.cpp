#include "tools/disk_tool.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "lapwing/region/geodesic.h"
#include "tools/selection_edits.h"

namespace lapwing::viewer {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// A hand that clicks moves by less.
constexpr double kClickPixels = 4.0;

// Of a click, before any disk was dragged: a part of the mesh's diagonal.
constexpr double kFirstRadius = 0.1;

constexpr double kFactorOfSize = 1.1;

// The steps by which the event sizes a disk; 0 for any other.
double steps_of(const InputEvent& event) {
  if (event.kind == InputKind::scroll && event.modifiers == kSizes) return event.scroll;
  if (event.kind != InputKind::key || event.modifiers != Modifiers{}) return 0.0;
  return event.key == ']' ? 1.0 : event.key == '[' ? -1.0 : 0.0;
}

// Shares of the corners of a triangle in a point of its plane; equal ones if it has no area.
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
  if (event.kind == InputKind::press && event.button == MouseButton::left) {
    const auto pick = scene.pick(event.position);
    if (!pick) return ToolAnswer::passed_on();
    begin(*pick, event, scene);
    return ToolAnswer::only_taken();
  }
  if (const double steps = steps_of(event); steps != 0.0 && center_ != kNoIndex) {
    return resized(steps);
  }
  if (!dragging_) return ToolAnswer::passed_on();
  if (event.kind == InputKind::key && event.key == kEscape) {
    reset();
    return ToolAnswer::only_taken();
  }
  const bool releases = event.kind == InputKind::release && event.button == MouseButton::left;
  if (event.kind != InputKind::move && !releases) return ToolAnswer::passed_on();
  has_moved_ = has_moved_ || (event.position - start_).norm() > kClickPixels;
  if (has_moved_ && event.kind == InputKind::move) radius_ = radius_at(event.position, scene);
  if (!releases) return ToolAnswer::only_taken();
  dragging_ = false;
  return chosen();
}

void DiskTool::begin(const SurfacePoint& pick, const InputEvent& event, const ToolScene& scene) {
  dragging_ = true;
  has_moved_ = false;
  part_ = scene.part;
  center_ = pick.vertex;
  start_ = event.position;
  if (radius_ == 0.0) radius_ = kFirstRadius * bounds_of(scene.positions).diagonal();
  distances_ =
      geodesic_distances(surface_of(scene.state)->topology(), scene.positions, {&center_, 1});
}

// The distance along the surface where the cursor is on it, else straight across the view.
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
  if (may_change_choice() && !vertices_of(state.selection, part).empty()) {
    return "Ctrl + wheel sizes the disk; Enter accepts it";
  }
  return of_part(part, "drag from the middle of the region to edit to its rim",
                 "choose the belt, between ROI and handle",
                 "drag from the middle of a handle in the ROI to its rim");
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
