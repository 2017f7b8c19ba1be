#include "tools/transplant_draft.h"

#include <algorithm>
#include <cmath>

#include "lapwing/mesh/transform.h"
#include "lapwing/region/geodesic.h"
#include "lapwing/run/run_step.h"
#include "lapwing/transplant/part_library.h"
#include "lapwing/transplant/placed_part.h"
#include "lapwing/transplant/surface_placement.h"

namespace lapwing::viewer {
namespace {

using Eigen::Vector3d;

const std::string kWhere = "the part";

// In diagonals of the surface. A loop with a radius between the first two keeps its size; any other
// is scaled to the third.
constexpr double kLeastRadius = 0.01;
constexpr double kMostRadius = 0.12;
constexpr double kUsualRadius = 0.06;

// Tolerance for the centre of a hole that `hole()` wrote, in radii.
constexpr double kRounding = 1e-6;

// Returns the hole_share of a disk that `hole()` wrote; nullopt for other regions.
std::optional<double> share_of(const RegionSpec& hole, const LoopFrame& frame) {
  const auto* inside = std::get_if<DiskInRegion>(&hole.form);
  if (inside == nullptr || inside->parts.size() != 1) return {};
  const auto* disk = std::get_if<GeodesicDisk>(&inside->parts.front().form);
  const auto* center = disk == nullptr ? nullptr : std::get_if<Vector3d>(&disk->center);
  if (center == nullptr || (*center - frame.center).norm() > kRounding * frame.radius) return {};
  return disk->radius / frame.radius;
}

}  // namespace

TransplantPart read_transplant_part(const std::filesystem::path& file) {
  lapwing::Part read = read_part(file);
  TransplantPart part;
  part.file = std::filesystem::absolute(file).lexically_normal();
  part.loop_number = read.loop;
  part.mesh = std::move(read.mesh);
  part.loop = loop_points(read.loops[read.loop], part.mesh.positions);
  return part;
}

LoopFrame TransplantDraft::frame() const {
  return loop_frame(LoopCurve(transformed(part->loop, placement), kWhere));
}

RegionSpec TransplantDraft::hole() const {
  if (chosen_hole) return *chosen_hole;
  const LoopFrame now = frame();
  return {DiskInRegion{{RegionSpec{GeodesicDisk{now.center, hole_share * now.radius}}}},
          "the part's hole"};
}

TransplantStep TransplantDraft::step() const {
  TransplantStep step;
  step.part = part->file;
  step.part_region = part->region;
  step.loop = part->loop_number;
  step.place = MatrixMove{placement.matrix().topRows<3>()};
  step.target_region = hole();
  step.parameters = parameters;
  return step;
}

TransplantDraft draft_with(std::shared_ptr<const TransplantPart> part, double diagonal) {
  TransplantDraft draft;
  draft.part = std::move(part);
  const double radius = draft.frame().radius;
  if (radius < kLeastRadius * diagonal || radius > kMostRadius * diagonal) {
    draft.placement.linear() *= kUsualRadius * diagonal / radius;
  }
  return draft;
}

TransplantDraft taken_up(const TransplantStep& step, const AppState& host) {
  const CutHole hole = cut_hole(step.target_region, *host.rest);
  const std::shared_ptr<const Mesh> read = read_part_mesh(step, {}, {});
  PlacedPart placed = place_part(step, read ? *read : *host.rest, *host.rest, hole);
  if (placed.motion.linear().determinant() < 0.0) {
    std::reverse(placed.loop.begin(), placed.loop.end());
  }
  transform(placed.mesh, placed.motion.inverse());
  TransplantPart part{step.part, step.part_region, step.loop, std::move(placed.mesh), {}};
  part.loop = loop_points(placed.loop, part.mesh.positions);

  TransplantDraft draft;
  draft.part = std::make_shared<const TransplantPart>(std::move(part));
  draft.placement = placed.motion;
  draft.stands = true;
  draft.parameters = step.parameters;
  if (const auto share = share_of(step.target_region, draft.frame())) {
    draft.hole_share = *share;
  } else {
    draft.chosen_hole = step.target_region;
  }
  return draft;
}

void TransplantDraft::stand_at(const Vector3d& point, const Vector3d& normal) {
  placement = place_at(placement, part->loop, {point, normal}, kWhere);
  stands = true;
}

void TransplantDraft::turn_by(double degrees) {
  if (!stands) return;
  const LoopFrame now = frame();
  placement = place_at(placement, part->loop, {now.center, now.normal, degrees}, kWhere);
}

void TransplantDraft::scale_by(double factor) {
  if (!stands) return;
  const LoopFrame now = frame();
  placement = place_at(placement, part->loop, {now.center, now.normal, 0.0, factor}, kWhere);
}

Vector3d normal_around(const SurfacePoint& point, double radius, const Topology& topology,
                       const Positions& positions) {
  const auto area = [&](const Triangle& t) -> Vector3d {
    return (positions[t[1]] - positions[t[0]]).cross(positions[t[2]] - positions[t[0]]);
  };
  const Triangle& own = topology.triangles[point.triangle];
  const auto distances = geodesic_distances(topology, positions, own, radius);
  Vector3d sum = Vector3d::Zero();
  for (Index v = 0; v < distances.size(); ++v) {
    if (!(distances[v] < radius)) continue;
    for (const Index t : topology.vertex_triangles[v]) {
      sum += (1.0 - distances[v] / radius) * area(topology.triangles[t]);
    }
  }
  if (sum.norm() > 0.0) return sum.normalized();
  return area(own).norm() > 0.0 ? area(own).normalized() : Vector3d(Vector3d::UnitZ());
}

}  // namespace lapwing::viewer
