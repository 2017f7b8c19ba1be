#pragma once

#include <cmath>
#include <functional>
#include <string>

#include "lapwing/deform/deform.h"
#include "lapwing/deform/modifiers/mirrored_request.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/region/vertex_set.h"

namespace lapwing::test {

/// A mesh that is its own mirror image, with places to edit it at.
struct MirrorScene {
  Mesh mesh;
  MirrorPlane plane;
  RegionSpec belt;    ///< on both sides
  RegionSpec side;    ///< on one side
  RegionSpec across;  ///< on both sides
  RegionSpec roi = {AllVertices{}, "roi"};
  Index side_vertex = 0;
  Index plane_vertex = 0;

  double diagonal() const { return bounds_of(mesh.positions).diagonal(); }
  /// A vector in the space of the scene, of the size of a tenth of the mesh: across the plane,
  /// along it, and the third.
  Eigen::Vector3d way(double out, double along, double third) const {
    const Eigen::Vector3d n = plane.normal.normalized();
    const Eigen::Vector3d u = n.unitOrthogonal();
    return 0.1 * diagonal() * (out * n + along * u + third * n.cross(u));
  }
  DeformRequest request() const {
    DeformRequest request;
    request.roi = roi;
    request.belt = belt;
    request.mirror = MirrorSpec{plane};
    return request;
  }
};

/// How far `positions` of the scene's mesh are from their own mirror image, a share of the
/// diagonal.
inline double asymmetry(const MirrorScene& scene, const Positions& positions) {
  const auto images = mirror_images(scene.mesh, scene.plane, "mirror");
  const Eigen::Affine3d mirror = reflection(scene.plane);
  double largest = 0.0;
  for (std::size_t v = 0; v < positions.size(); ++v) {
    largest = std::max(largest, (mirror * positions[v] - positions[images[v]]).norm());
  }
  return largest / scene.diagonal();
}

inline RegionSpec within(const Mesh& mesh, const std::function<bool(const Eigen::Vector3d&)>& is) {
  VertexSet set;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (is(mesh.positions[v])) set.push_back(v);
  }
  return {ListedVertices{set}};
}

inline RegionSpec disk(const Eigen::Vector3d& near, double radius) {
  return {GeodesicDisk{near, radius}};
}

inline Index nearest_vertex(const Mesh& mesh, const Eigen::Vector3d& place) {
  Index nearest = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const auto distance = [&](Index w) { return (mesh.positions[w] - place).norm(); };
    if (distance(v) < distance(nearest)) nearest = v;
  }
  return nearest;
}

/// A sheet with hills, symmetric in x = 1/2, where it has vertices.
inline MirrorScene sheet_scene() {
  MirrorScene scene{.mesh = grid(20, 20), .plane = {{0.5, 0, 0}, {-2, 0, 0}}};
  for (Eigen::Vector3d& p : scene.mesh.positions) {
    p.z() = 0.03 * std::cos(40.0 * std::abs(p.x() - 0.5)) * std::sin(23.0 * p.y());
  }
  scene.belt = within(scene.mesh, [](const auto& p) { return p.y() < 0.12; });
  scene.side = disk({0.25, 0.75, 0}, 0.12);
  scene.across = disk({0.55, 0.95, 0}, 0.12);
  scene.side_vertex = nearest_vertex(scene.mesh, {0.8, 0.45, 0});
  scene.plane_vertex = nearest_vertex(scene.mesh, {0.5, 0.4, 0});
  return scene;
}

/// A tube with ripples, symmetric in y = 0.
inline MirrorScene tube_scene() {
  MirrorScene scene{.mesh = cylinder(20, 31, 0.5, 3.0), .plane = {{0, 0, 0}, {0, 1, 0}}};
  for (Eigen::Vector3d& p : scene.mesh.positions) {
    p.head<2>() *= 1.0 + 0.06 * std::sin(9.0 * p.z()) * std::cos(6.0 * std::abs(p.y()));
  }
  scene.belt = within(scene.mesh, [](const auto& p) { return p.z() < 0.25; });
  scene.side = disk({0, 0.5, 2.4}, 0.3);
  scene.across = disk({0.5, 0.1, 1.6}, 0.3);
  scene.side_vertex = nearest_vertex(scene.mesh, {0.1, 0.5, 1.2});
  scene.plane_vertex = nearest_vertex(scene.mesh, {0.5, 0, 1.0});
  return scene;
}

/// A ball with bumps, symmetric in a plane of no axis. Its coordinates are not exact.
inline MirrorScene ball_scene() {
  MirrorScene scene{.mesh = icosphere(3), .plane = {}};
  const auto bumpy = [](const Eigen::Vector3d& p) {
    return Eigen::Vector3d(
        p * (1.0 + 0.05 * std::sin(8.0 * std::abs(p.x())) * std::cos(9.0 * p.z() + 4.0 * p.y())));
  };
  const Eigen::Affine3d place = Eigen::Translation3d(3, -1, 2) *
                                Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -1).normalized());
  for (Eigen::Vector3d& p : scene.mesh.positions) p = place * bumpy(p);
  scene.plane = {place.translation(), place.linear().col(0)};
  const Eigen::Affine3d back = place.inverse();
  const auto at = [&](double x, double y, double z) {
    return Eigen::Vector3d(place * bumpy(Eigen::Vector3d(x, y, z).normalized()));
  };
  scene.belt = within(scene.mesh, [&](const auto& p) { return (back * p).z() < -0.6; });
  scene.roi = {
      DifferenceRegion{
          {scene.roi, within(scene.mesh, [&](const auto& p) { return (back * p).z() < -0.85; })}},
      "roi"};
  scene.belt = {DifferenceRegion{
      {scene.belt, within(scene.mesh, [&](const auto& p) { return (back * p).z() < -0.85; })}}};
  scene.side = disk(at(0.8, 0, 0.6), 0.35);
  scene.across = disk(at(0.1, 0, 1), 0.35);
  scene.side_vertex = nearest_vertex(scene.mesh, at(-0.7, 0.7, 0));
  scene.plane_vertex = nearest_vertex(scene.mesh, at(0, 0.9, 0.3));
  return scene;
}

}  // namespace lapwing::test
