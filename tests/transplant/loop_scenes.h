#pragma once

#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

#include <Eigen/Geometry>

#include "lapwing/doctor/check.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/region/boundary_loops.h"
#include "lapwing/transplant/bridge.h"
#include "lapwing/transplant/join.h"

namespace lapwing::test {

/// A closed curve around the z axis: the point at an angle.
using Curve = std::function<Eigen::Vector3d(double)>;

inline Eigen::Vector3d polar(double angle, double radius, double z) {
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}
inline Curve circle(double radius, double z = 0.0) {
  return [=](double angle) { return polar(angle, radius, z); };
}
/// `spikes` spikes between two radii.
inline Curve star(double inner, double outer, int spikes, double z = 0.0) {
  return [=](double angle) {
    const double wave = 0.5 + 0.5 * std::cos(spikes * angle);
    return polar(angle, inner + (outer - inner) * wave, z);
  };
}
inline Curve saddle(double radius, double height, double z = 0.0) {
  return [=](double angle) { return polar(angle, radius, z + height * std::cos(2.0 * angle)); };
}
inline Curve moved(const Curve& curve, const Eigen::Affine3d& motion) {
  return [=](double angle) { return Eigen::Vector3d(motion * curve(angle)); };
}

/// A ring of triangles with one of its two boundary loops, whose vertices are the first.
struct Rim {
  Mesh mesh;
  BoundaryLoop loop;
  BridgeLoop bridge_loop() const {
    const Topology& topology = mesh.topology();
    return lapwing::bridge_loop(topology.triangles, mesh.positions, loop);
  }
};

/// The ring between `edge`, at `count` angles from `start` on, and `behind`. Its loop goes round as
/// a hole's does that is seen from +z (`hole`), or the other way.
inline Rim ring(Index count, const Curve& edge, const Curve& behind, bool hole,
                double start = 0.0) {
  Rim rim;
  for (const Curve* curve : {&edge, &behind}) {
    for (Index k = 0; k < count; ++k) {
      const double turn = 2.0 * std::numbers::pi * k / count;
      rim.mesh.positions.push_back((*curve)(start + (hole ? -turn : turn)));
    }
  }
  for (Index k = 0; k < count; ++k) {
    const Index next = (k + 1) % count;
    rim.mesh.add_face(std::array{k, next, count + next});
    rim.mesh.add_face(std::array{k, count + next, count + k});
    rim.loop.push_back(k);
  }
  return rim;
}

/// The curve beside `curve` at `distance` to the left in the plane z = 0, seen from +z.
inline Curve beside(const Curve& curve, double distance) {
  return [=](double angle) {
    const Eigen::Vector3d along = (curve(angle + 1e-4) - curve(angle - 1e-4)).normalized();
    return Eigen::Vector3d(curve(angle) + distance * Eigen::Vector3d(-along.y(), along.x(), 0.0));
  };
}

/// A flat sheet around a hole, seen from +z.
inline Rim hole_in_sheet(Index count, const Curve& edge, double start = 0.0) {
  return ring(count, edge, beside(edge, -0.02), true, start);
}
/// The rim of a flat part, seen from +z.
inline Rim flat_part(Index count, const Curve& edge, double start = 0.0) {
  return ring(count, edge, beside(edge, 0.02), false, start);
}
/// A tube that goes up from `edge`.
inline Rim upright_part(Index count, const Curve& edge, double start = 0.0) {
  return ring(
      count, edge,
      [edge](double angle) { return Eigen::Vector3d(edge(angle) + Eigen::Vector3d(0, 0, 2)); },
      false, start);
}

inline Bridge bridge(const Rim& host, const Rim& part) {
  return bridge_loops(host.bridge_loop(), part.bridge_loop(), "zip");
}
inline Joined join(const Rim& host, const Rim& part, const Bridge& bridge) {
  return lapwing::join(host.mesh, host.loop, part.mesh, part.loop, bridge, "");
}

/// What keeps a mesh from being an oriented manifold; empty if nothing does.
inline std::string manifold_faults(const Mesh& mesh) {
  const CheckReport report = check(mesh);
  std::string faults;
  for (const DefectKind kind :
       {DefectKind::degenerate_face, DefectKind::repeated_face, DefectKind::loose_vertex,
        DefectKind::non_manifold_edge, DefectKind::bow_tie_vertex,
        DefectKind::inconsistent_orientation, DefectKind::one_sided_surface}) {
    if (const Defect* defect = report.find(kind)) {
      faults += std::to_string(defect->count) + " " + std::string(describe(kind).name) + "; ";
    }
  }
  return faults;
}

inline Eigen::Vector3d area_vector(const Mesh& mesh, Index face) {
  const auto corners = mesh.face(face);
  const Eigen::Vector3d& a = mesh.positions[corners[0]];
  return 0.5 * (mesh.positions[corners[1]] - a).cross(mesh.positions[corners[2]] - a);
}

/// The smallest angle of a triangle, in degrees.
inline double least_angle(const Mesh& mesh, Index face) {
  const auto corners = mesh.face(face);
  double least = 180.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Eigen::Vector3d a = mesh.positions[corners[(k + 1) % 3]] - mesh.positions[corners[k]];
    const Eigen::Vector3d b = mesh.positions[corners[(k + 2) % 3]] - mesh.positions[corners[k]];
    least = std::min(least, std::atan2(a.cross(b).norm(), a.dot(b)) * 180.0 / std::numbers::pi);
  }
  return least;
}

}  // namespace lapwing::test
