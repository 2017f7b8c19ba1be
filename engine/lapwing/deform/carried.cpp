#include "lapwing/deform/carried.h"

#include <algorithm>
#include <numeric>

#include "lapwing/base/errors.h"
#include "lapwing/base/parallel.h"
#include "lapwing/laplacian/rotation.h"

namespace lapwing {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr std::size_t kPointsPerTask = 64;

Adjacency one_group(const Topology& topology) {
  if (topology.triangles.empty()) {
    throw InputError("a surface without triangles carries nothing along");
  }
  Adjacency group;
  group.values.resize(topology.triangles.size());
  std::iota(group.values.begin(), group.values.end(), Index{0});
  group.starts.push_back(static_cast<Index>(group.values.size()));
  return group;
}

// All that may move: loose parts ride along and are no part of the ROI that is solved for.
std::vector<Index> moving_vertices(const EditRegion& region) {
  std::vector<Index> moving = region.roi;
  for (const LoosePart& part : region.loose) {
    moving.insert(moving.end(), part.vertices.begin(), part.vertices.end());
  }
  return moving;
}

}  // namespace

SurfaceCarrier::SurfaceCarrier(std::span<const Vector3d> rest, const Deformed& deformed)
    : rest_(rest),
      deformed_(deformed),
      topology_(deformed.mesh.topology()),
      motion_(vertex_motion(moving_vertices(deformed.region), rest, deformed.mesh.positions,
                            topology_)),
      widest_band_(kWidestCarryBand * bounds_of(rest).diagonal()),
      surface_(topology_.triangles, rest, one_group(topology_)) {
  for (const auto& [a, b, c] : topology_.triangles) {
    areas_.push_back((rest[b] - rest[a]).cross(rest[c] - rest[a]).norm());
  }
}

std::vector<SurfaceCarrier::Contact> SurfaceCarrier::contacts_of(const Vector3d& point,
                                                                 Index& hint) const {
  const TrianglePoint nearest = surface_.find(0, point, Vector3d::Zero(), hint);
  hint = nearest.hint;
  const double distance = (nearest.position - point).norm();
  const double band = std::min(kCarryBand * distance, widest_band_);
  std::vector<Contact> contacts;
  double sum = 0.0;
  if (band > 0.0) {
    for (const TrianglePoint& place : surface_.within(0, point, distance + band)) {
      const double excess = ((place.position - point).norm() - distance) / band;
      const double closeness = std::clamp(1.0 - excess, 0.0, 1.0);
      contacts.push_back({place, closeness * closeness * areas_[place.triangle]});
      sum += contacts.back().weight;
    }
  }
  if (!(sum > 0.0)) return {{nearest, 1.0}};
  for (Contact& contact : contacts) contact.weight /= sum;
  return contacts;
}

bool SurfaceCarrier::is_still(std::span<const Contact> contacts) const {
  return std::all_of(contacts.begin(), contacts.end(), [&](const Contact& contact) {
    const Triangle& corners = topology_.triangles[contact.place.triangle];
    return std::all_of(corners.begin(), corners.end(), [&](Index v) {
      return motion_.displacements[v].isZero(0.0) && motion_.rotations[v].vec().isZero(0.0);
    });
  });
}

void SurfaceCarrier::carry(const Vector3d& point, Index& hint, Vector3d& position,
                           Quaterniond& rotation) const {
  const std::vector<Contact> contacts = contacts_of(point, hint);
  position = point;
  rotation = Quaterniond::Identity();
  if (is_still(contacts)) return;
  Vector3d arm = point;
  Vector3d there = Vector3d::Zero();
  Matrix3d turns = Matrix3d::Zero();
  double scale = 0.0;
  for (const auto& [place, weight] : contacts) {
    const Triangle& corners = topology_.triangles[place.triangle];
    for (std::size_t c = 0; c < 3; ++c) {
      const double share = weight * place.weights[c];
      const Index v = corners[c];
      arm -= share * rest_[v];
      there += share * deformed_.mesh.positions[v];
      turns += share * motion_.rotations[v].toRotationMatrix();
      scale += share * (deformed_.asked_scales.empty() ? 1.0 : deformed_.asked_scales[v]);
    }
  }
  const Matrix3d R = nearest_rotation(turns);
  position = there + scale * (R * arm);
  rotation = unit_quaternion(R);
}

CarriedPoints SurfaceCarrier::carry(std::span<const Vector3d> points) const {
  CarriedPoints carried;
  carried.positions.resize(points.size());
  carried.rotations.resize(points.size());
  parallel_for(points.size(), kPointsPerTask, [&](std::size_t begin, std::size_t end) {
    Index hint = kNoIndex;
    for (std::size_t p = begin; p < end; ++p) {
      carry(points[p], hint, carried.positions[p], carried.rotations[p]);
    }
  });
  return carried;
}

CarriedPoints carry_points(std::span<const Vector3d> points, std::span<const Vector3d> rest,
                           const Deformed& deformed) {
  return SurfaceCarrier(rest, deformed).carry(points);
}

}  // namespace lapwing
