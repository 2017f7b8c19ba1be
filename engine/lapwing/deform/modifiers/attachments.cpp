#include "lapwing/deform/modifiers/attachments.h"

#include <algorithm>
#include <atomic>
#include <utility>

#include "lapwing/base/errors.h"
#include "lapwing/base/parallel.h"
#include "lapwing/laplacian/rotation.h"

namespace lapwing {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr std::size_t kPointsPerTask = 64;

const std::vector<Triangle>& triangles_of(const Topology& topology) {
  if (topology.triangles.empty()) {
    throw InputError(
        "a surface without triangles cannot carry attachments; use a mesh with triangles");
  }
  return topology.triangles;
}

// Returns the ROI and the loose parts, which follow the surface but are not unknowns.
std::vector<Index> moving_vertices(const EditRegion& region) {
  std::vector<Index> moving = region.roi;
  for (const LoosePart& part : region.loose) {
    moving.insert(moving.end(), part.vertices.begin(), part.vertices.end());
  }
  return moving;
}

// Merges the shares of equal vertices and sorts by vertex.
void merge(std::vector<CarryShare>& shares) {
  std::stable_sort(shares.begin(), shares.end(),
                   [](const CarryShare& a, const CarryShare& b) { return a.vertex < b.vertex; });
  std::size_t kept = 0;
  for (const CarryShare& of : shares) {
    if (kept > 0 && shares[kept - 1].vertex == of.vertex) {
      shares[kept - 1].share += of.share;
    } else {
      shares[kept++] = of;
    }
  }
  shares.resize(kept);
}

}  // namespace

SurfaceContacts::SurfaceContacts(std::span<const Vector3d> rest, const Topology& topology)
    : rest_(rest),
      topology_(topology),
      widest_band_(kWidestCarryBand * bounds_of(surface_positions(rest, topology)).diagonal()),
      surface_(triangles_of(topology), rest) {
  for (const auto& [a, b, c] : topology_.triangles) {
    areas_.push_back((rest[b] - rest[a]).cross(rest[c] - rest[a]).norm());
  }
}

void SurfaceContacts::find(const Vector3d& point, Index& hint,
                           std::vector<CarryShare>& shares) const {
  const TrianglePoint nearest = surface_.find(0, point, Vector3d::Zero(), hint);
  hint = nearest.hint;
  shares.clear();
  const auto add = [&](const TrianglePoint& place, double weight) {
    const Triangle& corners = topology_.triangles[place.triangle];
    for (std::size_t c = 0; c < 3; ++c) shares.push_back({corners[c], weight * place.weights[c]});
  };
  const double distance = (nearest.position - point).norm();
  const double band = std::min(kCarryBand * distance, widest_band_);
  double sum = 0.0;
  if (band > 0.0) {
    for (const TrianglePoint& place : surface_.within(0, point, distance + band)) {
      const double excess = ((place.position - point).norm() - distance) / band;
      const double closeness = std::clamp(1.0 - excess, 0.0, 1.0);
      const double weight = closeness * closeness * areas_[place.triangle];
      add(place, weight);
      sum += weight;
    }
  }
  if (!(sum > 0.0)) {
    shares.clear();
    add(nearest, 1.0);
    sum = 1.0;
  }
  merge(shares);
  for (CarryShare& of : shares) of.share /= sum;
}

std::optional<CarryShares> SurfaceContacts::find_all(std::span<const Vector3d> points,
                                                     std::size_t most) const {
  std::vector<std::vector<CarryShare>> rows(points.size());
  std::atomic<std::size_t> count = 0;
  parallel_for(points.size(), kPointsPerTask, [&](std::size_t begin, std::size_t end) {
    Index hint = kNoIndex;
    std::vector<CarryShare> shares;
    for (std::size_t p = begin; p < end && count <= most; ++p) {
      find(points[p], hint, shares);
      rows[p].assign(shares.begin(), shares.end());
      count += shares.size();
    }
  });
  if (count > most) return std::nullopt;
  CarryShares all;
  all.values.reserve(count);
  for (const std::vector<CarryShare>& row : rows) {
    all.values.insert(all.values.end(), row.begin(), row.end());
    all.starts.push_back(all.values.size());
  }
  return all;
}

AttachmentDeformer::AttachmentDeformer(std::span<const Vector3d> rest, const Deformed& deformed)
    : AttachmentDeformer(std::make_shared<const SurfaceContacts>(rest, deformed.mesh.topology()),
                         deformed) {}

AttachmentDeformer::AttachmentDeformer(std::shared_ptr<const SurfaceContacts> contacts,
                                       const Deformed& deformed)
    : contacts_(std::move(contacts)),
      deformed_(deformed),
      motion_(vertex_motion(moving_vertices(deformed.region), contacts_->rest(),
                            deformed.mesh.positions, deformed.mesh.topology())) {}

bool AttachmentDeformer::is_still(std::span<const CarryShare> shares) const {
  return std::all_of(shares.begin(), shares.end(), [&](const CarryShare& of) {
    return motion_.displacements[of.vertex].isZero(0.0) &&
           motion_.rotations[of.vertex].vec().isZero(0.0);
  });
}

void AttachmentDeformer::carry(const Vector3d& point, std::span<const CarryShare> shares,
                               Vector3d& position, Quaterniond& rotation) const {
  position = point;
  rotation = Quaterniond::Identity();
  if (is_still(shares)) return;
  const std::span<const Vector3d> rest = contacts_->rest();
  Vector3d arm = point;
  Vector3d there = Vector3d::Zero();
  Matrix3d turns = Matrix3d::Zero();
  Matrix3d stretch = Matrix3d::Zero();
  for (const auto& [v, share] : shares) {
    arm -= share * rest[v];
    there += share * deformed_.mesh.positions[v];
    turns += share * motion_.rotations[v].toRotationMatrix();
    stretch += share * (deformed_.rest_stretch.empty() ? Matrix3d(Matrix3d::Identity())
                                                       : deformed_.rest_stretch[v]);
  }
  const Matrix3d R = nearest_rotation(turns);
  position = there + R * (stretch * arm);
  rotation = unit_quaternion(R);
}

CarriedPoints AttachmentDeformer::carry(std::span<const Vector3d> points) const {
  CarriedPoints carried;
  carried.positions.resize(points.size());
  carried.rotations.resize(points.size());
  parallel_for(points.size(), kPointsPerTask, [&](std::size_t begin, std::size_t end) {
    Index hint = kNoIndex;
    std::vector<CarryShare> shares;
    for (std::size_t p = begin; p < end; ++p) {
      contacts_->find(points[p], hint, shares);
      carry(points[p], shares, carried.positions[p], carried.rotations[p]);
    }
  });
  return carried;
}

CarriedPoints AttachmentDeformer::carry(std::span<const Vector3d> points,
                                        const CarryShares& shares) const {
  CarriedPoints carried;
  carried.positions.resize(points.size());
  carried.rotations.resize(points.size());
  parallel_for(points.size(), kPointsPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) {
      carry(points[p], shares[p], carried.positions[p], carried.rotations[p]);
    }
  });
  return carried;
}

CarriedPoints carry_points(std::span<const Vector3d> points, std::span<const Vector3d> rest,
                           const Deformed& deformed) {
  return AttachmentDeformer(rest, deformed).carry(points);
}

}  // namespace lapwing
