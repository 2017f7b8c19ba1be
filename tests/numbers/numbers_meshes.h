#pragma once

#include <cmath>

#include "lapwing/mesh/shapes.h"

namespace lapwing::test {

/// A ball on which no two edges are alike, so that rounding decides nothing.
inline Mesh bumpy_ball() {
  Mesh ball = icosphere(3);
  for (std::size_t v = 0; v < ball.vertex_count(); ++v) {
    ball.positions[v] *= 1.0 + 0.05 * std::sin(static_cast<double>(7 * v));
  }
  return ball;
}

/// The same with a vertex next to the middle of an edge of every 40th face, from there by `height`
/// of the edge into the face: the triangle between them is a needle.
inline Mesh ball_with_needles(double height) {
  const Mesh whole = bumpy_ball();
  Mesh mesh;
  mesh.positions = whole.positions;
  for (std::size_t f = 0; f < whole.face_count(); ++f) {
    const auto face = whole.face(f);
    if (f % 40 != 0) {
      mesh.add_face(face);
      continue;
    }
    const auto middle = static_cast<Index>(mesh.vertex_count());
    const Eigen::Vector3d& a = whole.positions[face[0]];
    const Eigen::Vector3d& b = whole.positions[face[1]];
    const Eigen::Vector3d& c = whole.positions[face[2]];
    mesh.positions.push_back(0.6 * a + 0.4 * b + height * (c - 0.6 * a - 0.4 * b));
    for (std::size_t k = 0; k < 3; ++k) {
      const Index corners[] = {face[k], face[(k + 1) % 3], middle};
      mesh.add_face(corners);
    }
  }
  return mesh;
}

/// The same with every 40th face twice.
inline Mesh ball_with_repeated_faces() {
  const Mesh whole = bumpy_ball();
  Mesh mesh = whole;
  for (std::size_t f = 0; f < whole.face_count(); f += 40) mesh.add_face(whole.face(f));
  return mesh;
}

}  // namespace lapwing::test
