#include "tools/disk_tool.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <Eigen/Geometry>

#include "lapwing/region/geodesic.h"
#include "tools/selection_edits.h"

namespace lapwing::viewer {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// The cursor moves less than this during a click.
constexpr double kClickPt = 4.0;

// Radius of a clicked disk if none was dragged before, as a fraction of the mesh's diagonal.
constexpr double kFirstRadius = 0.1;

constexpr double kFactorOfSize = 1.1;

// Returns the barycentric coordinates of `p`; 1/3 each if the triangle has no area.
Vector3d barycentric(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& p) {
  const Vector3d normal = (b - a).cross(c - a);
  const double squared = normal.squaredNorm();
  if (squared == 0.0) return Vector3d::Constant(1.0 / 3.0);
  const double u = (c - b).cross(p - b).dot(normal) / squared;
  const double v = (a - c).cross(p - c).dot(normal) / squared;
  return {u, v, 1.0 - u - v};
}

constexpr std::size_t kGripCount = 8;
constexpr double kGripReachPt = 8.0;

Vector3d normal_of(const Triangle& t, std::span<const Vector3d> positions) {
  const Vector3d ab = positions[t[1]] - positions[t[0]];
  return ab.cross(positions[t[2]] - positions[t[0]]).stableNormalized();
}

// Returns two perpendicular unit tangents of the surface at a vertex.
std::array<Vector3d, 2> directions_at(Index vertex, const Topology& topology,
                                      std::span<const Vector3d> positions) {
  Vector3d normal = Vector3d::Zero();
  for (const Index t : topology.vertex_triangles[vertex]) {
    normal += normal_of(topology.triangles[t], positions);
  }
  if (normal.squaredNorm() == 0.0) normal = Vector3d::UnitZ();
  const Vector3d across = normal.unitOrthogonal();
  return {across, normal.cross(across).normalized()};
}

// Returns the index of the nearest grip that faces the camera and lies within kGripReachPt of
// `pixel`.
std::optional<std::size_t> grip_at(std::span<const RimGrip> grips, const Vector2d& pixel,
                                   const Projection& projection) {
  std::optional<std::size_t> nearest;
  double least = projection.in_pixels(kGripReachPt);
  for (std::size_t k = 0; k < grips.size(); ++k) {
    if (!grips[k].faces_eye(projection)) continue;
    const auto place = projection.to_pixel(grips[k].position);
    if (!place || (*place - pixel).norm() >= least) continue;
    least = (*place - pixel).norm();
    nearest = k;
  }
  return nearest;
}

}  // namespace

std::vector<RimGrip> rim_grips(const Topology& topology, std::span<const Vector3d> positions,
                               std::span<const double> distances, Index center, double radius) {
  const auto [across, up] = directions_at(center, topology, positions);
  struct Sector {
    double off = std::numeric_limits<double>::infinity();  // angle from its middle, in sectors
    RimGrip grip;
  };
  std::array<Sector, kGripCount> sectors;
  for (const Triangle& t : topology.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Index a = t[k];
      const Index b = t[(k + 1) % 3];
      if ((distances[a] <= radius) == (distances[b] <= radius)) continue;
      if (!std::isfinite(distances[a]) || !std::isfinite(distances[b])) continue;
      const double share = (radius - distances[a]) / (distances[b] - distances[a]);
      const Vector3d place = positions[a] + share * (positions[b] - positions[a]);
      const Vector3d from_center = place - positions[center];
      const double turn =
          std::atan2(from_center.dot(up), from_center.dot(across)) / (2.0 * std::numbers::pi);
      const double at = (turn < 0.0 ? turn + 1.0 : turn) * kGripCount;
      const double nearest = std::round(at);
      Sector& sector = sectors[static_cast<std::size_t>(nearest) % kGripCount];
      if (std::abs(at - nearest) >= sector.off) continue;
      sector = {std::abs(at - nearest), {place, normal_of(t, positions)}};
    }
  }
  std::vector<RimGrip> grips;
  for (const Sector& sector : sectors) {
    if (std::isfinite(sector.off)) grips.push_back(sector.grip);
  }
  return grips;
}

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
  if (const double steps = size_steps(event); steps != 0.0 && center_ != kNoIndex) {
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
    return chosen(false);
  }
  size_before_.reset();
  return follows_hand_ ? chosen(true) : ToolAnswer::only_taken();
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

// Updates the grips. There are none during a drag, while a result is missing, or if the disk is no
// longer the chosen region.
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
  const ChosenRegion& region = region_of(selection, part_);
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
  const Topology& topology = surface_of(scene.state)->topology();
  if (radius_ == 0.0) {
    radius_ = kFirstRadius * bounds_of(surface_positions(scene.positions, topology)).diagonal();
  }
  distances_ = geodesic_distances(topology, scene.positions, {&center_, 1});
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

ToolAnswer DiskTool::chosen(bool resizes) const {
  return {.taken = true,
          .command = Choose{part_, {GeodesicDisk{center_, radius_}, "disk"}},
          .resizes = resizes};
}

ToolAnswer DiskTool::resized(double steps) {
  radius_ *= std::pow(kFactorOfSize, steps);
  return dragging_ ? ToolAnswer::only_taken() : chosen(true);
}

const char* DiskTool::hint(const AppState& state, const Part& part) const {
  if (hovered_) return "Drag the dot to resize the disk.";
  if (may_change_choice() && !vertices_of(state.selection, part).empty()) {
    return "Ctrl+wheel or a dot on its edge resizes the disk. Enter continues.";
  }
  return of_part(part, "Drag from the centre of the region to its edge.",
                 "Drag a disk over the vertices to hold in place, inside the region.",
                 "Drag from the centre of a handle to its edge, inside the region.");
}

ToolMarks DiskTool::marks() const {
  return {.grips = grips_, .grip = hovered_};
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
