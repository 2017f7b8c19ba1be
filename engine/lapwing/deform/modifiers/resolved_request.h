#pragma once

#include <numbers>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/deform/deform_request.h"
#include "lapwing/deform/handle_motion.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/region/edit_region.h"

namespace lapwing {

/// A request with its regions resolved. Everything it refers to must outlive it.
struct ResolvedRequest {
  const DeformRequest& request;
  const EditRegion& region;
  const Topology& topology;
  /// The handles' centroids before the request is carried out.
  std::span<const Eigen::Vector3d> centroids;

  /// Returns the motion of handle `h` from its place after share `from` of the request to its place
  /// after share `to`.
  Eigen::Affine3d motion(std::size_t h, double from, double to) const {
    const Eigen::Affine3d there = to_affine(request.handles[h].move, centroids[h], to);
    if (from == 0.0) return there;
    return there * to_affine(request.handles[h].move, centroids[h], from).inverse();
  }

  /// Returns the turn of each handle from share `from` to share `to`, whole turns included.
  std::vector<Eigen::AngleAxisd> turns(double from, double to) const {
    std::vector<Eigen::AngleAxisd> all;
    for (const MovedHandle& handle : request.handles) {
      const AxisRotation whole = turn_of(handle.move);
      all.emplace_back((to - from) * whole.degrees * std::numbers::pi / 180.0, whole.axis);
    }
    return all;
  }

  /// Returns `motion` of all handles.
  std::vector<Eigen::Affine3d> motions(double from, double to) const {
    std::vector<Eigen::Affine3d> all;
    for (std::size_t h = 0; h < request.handles.size(); ++h) all.push_back(motion(h, from, to));
    return all;
  }

  HandleMotions handle_motions(double from, double to) const {
    return {motions(from, to), turns(from, to), free_handles()};
  }

  /// Whether each handle's orientation is free; empty if none is.
  std::vector<char> free_handles() const {
    std::vector<char> free;
    bool any = false;
    for (const MovedHandle& handle : request.handles) {
      free.push_back(handle.orientation == HandleOrientation::free ? 1 : 0);
      any = any || free.back() != 0;
    }
    return any ? free : std::vector<char>();
  }

  /// Returns the waypoints of the request's paths, in order. Empty without paths.
  std::vector<HandleMotions> path() const;
};

}  // namespace lapwing
