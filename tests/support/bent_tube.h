#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "lapwing/deform/deform_request.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/region/edit_region.h"
#include "support/largest_distance.h"

namespace lapwing::test {

/// Returns a bumpy tube along z. Edits fix its lower end and move its upper end.
inline Mesh bumpy_tube() {
  Mesh mesh = cylinder(12, 20, 0.5, 3.0);
  for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
    mesh.positions[i].head<2>() *= 1.0 + 0.1 * std::sin(5.0 * static_cast<double>(i));
  }
  return mesh;
}

inline EditRegion foot_and_head(const Mesh& mesh) {
  EditRegion region;
  region.handles.resize(1);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    region.roi.push_back(v);
    if (v < 24) region.belt.push_back(v);
    if (v >= mesh.vertex_count() - 24) region.handles[0].push_back(v);
  }
  return region;
}

/// Returns a request that moves the handle of `region` and fixes its belt.
inline DeformRequest moved_head(const EditRegion& region, const Move& move) {
  DeformRequest request;
  request.roi = {ListedVertices{region.roi}};
  request.belt = RegionSpec{ListedVertices{region.belt}};
  request.handles = {{{ListedVertices{region.handles[0]}}, move}};
  return request;
}

inline Eigen::Affine3d bend() {
  return Eigen::Translation3d(0.5, 0.0, -0.3) * Eigen::Translation3d(0, 0, 3) *
         Eigen::AngleAxisd(0.6, Eigen::Vector3d::UnitY()) * Eigen::Translation3d(0, 0, -3);
}

}  // namespace lapwing::test
