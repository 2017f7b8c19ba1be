#include "lapwing/deform/modifiers/rigid_parts.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace lapwing {
namespace {

using Eigen::Affine3d;
using Eigen::Matrix3Xd;

// Parts with fewer vertices have no unique orientation.
constexpr std::size_t kSmallestPart = 3;

// The constraint weight of a rigid part that becomes a handle, if the edit prescribes the weight of
// its constraints.
constexpr double kRigidWeight = 1e3;

std::vector<VertexSet> rigid_parts(const EditRegion& region, const Topology& topology) {
  std::vector<char> waits(topology.vertex_count(), 0);
  for (const auto& [v, factor] : region.stiffness) waits[v] = factor == kRigidStiffness ? 1 : 0;
  std::vector<VertexSet> parts;
  for (const auto& [first, factor] : region.stiffness) {
    if (waits[first] == 0) continue;
    waits[first] = 0;
    std::vector<Index> part{first};
    for (std::size_t k = 0; k < part.size(); ++k) {
      for (const Index j : topology.rings[part[k]]) {
        if (std::exchange(waits[j], char{0}) != 0) part.push_back(j);
      }
    }
    if (part.size() >= kSmallestPart) parts.push_back(make_vertex_set(std::move(part)));
  }
  return parts;
}

}  // namespace

std::optional<EditRegion> with_rigid_handles(EditRegion region, const Topology& topology,
                                             std::optional<double> constraint_weight) {
  const std::size_t handles = region.handles.size();
  bool changes = false;
  for (const VertexSet& part : rigid_parts(region, topology)) {
    std::vector<VertexSet*> holders;
    for (VertexSet& handle : region.handles) {
      if (!intersect(handle, part).empty()) holders.push_back(&handle);
    }
    if (!intersect(region.belt, part).empty()) holders.push_back(&region.belt);
    if (holders.size() > 1 || !intersect(corners_of(region.targets), part).empty()) continue;
    if (holders.empty()) {
      region.handles.push_back(part);
      if (constraint_weight) {
        region.handle_weights.resize(region.handles.size());
        region.handle_weights.back() = kRigidWeight / *constraint_weight;
      }
    } else if (VertexSet all = unite(*holders[0], part); all != *holders[0]) {
      *holders[0] = std::move(all);
    } else {
      continue;
    }
    std::erase_if(region.graded, [&](const FalloffVertex& graded) {
      return std::ranges::binary_search(part, graded.vertex);
    });
    changes = true;
  }
  if (!changes) return std::nullopt;
  if (!region.handle_weights.empty()) region.handle_weights.resize(region.handles.size());
  for (LoosePart& part : region.loose) {
    for (LooseAnchor& anchor : part.anchors) {
      if (anchor.handle == handles) anchor.handle = region.handles.size();
    }
  }
  return region;
}

HandleMotions with_rigid_motions(const HandleMotions& motions, const EditRegion& rigid,
                                 std::span<const Eigen::Vector3d> rest,
                                 std::span<const Eigen::Vector3d> displacement) {
  HandleMotions all{motions.maps, motions.turns};
  for (std::size_t h = motions.maps.size(); h < rigid.handles.size(); ++h) {
    const VertexSet& part = rigid.handles[h];
    Matrix3Xd from(3, part.size());
    Matrix3Xd to(3, part.size());
    for (std::size_t k = 0; k < part.size(); ++k) {
      const auto column = static_cast<Eigen::Index>(k);
      from.col(column) = rest[part[k]];
      to.col(column) = rest[part[k]] + displacement[part[k]];
    }
    const Affine3d map(Eigen::umeyama(from, to, false));
    all.maps.push_back(map);
    all.turns.push_back(shortest_turn(map));
  }
  return all;
}

}  // namespace lapwing
