#include "fuzz/choices.h"

#include <algorithm>

namespace lapwing::fuzz {

VertexSet Choices::vertices(Index count) {
  // On these shapes, vertices with consecutive indices form a patch.
  const Index first = below(count);
  const Index many = 1 + below(std::max<Index>(1, count / 3));
  VertexSet chosen;
  for (Index v = first; v < std::min(count, first + many); ++v) chosen.push_back(v);
  return chosen;
}

RegionSpec Choices::region(const Mesh& mesh) {
  const auto count = static_cast<Index>(mesh.vertex_count());
  switch (byte() % 6) {
    case 0:
      return {AllVertices{}};
    case 1:
      return {ListedVertices{vertices(count)}};
    case 2:
      return {GeodesicDisk{below(count), above_zero()}};
    case 3: {
      const Eigen::Vector3d corner = vector();
      return {Box{corner, corner + Eigen::Vector3d(above_zero(), above_zero(), above_zero())}};
    }
    case 4:
      return {DifferenceRegion{{{AllVertices{}}, {ListedVertices{vertices(count)}}}}};
    default:
      return {DiskInRegion{{{ListedVertices{vertices(count)}}}}};
  }
}

RegionSpec Choices::patch(const Mesh& mesh) {
  if (one_in(4)) return region(mesh);
  const Index center = below(static_cast<Index>(mesh.vertex_count()));
  return {GeodesicDisk{center, between(0.3, 1.2)}};
}

Move Choices::move() {
  if (one_in(5)) {
    MatrixMove move;
    for (double& entry : move.matrix.reshaped()) entry = number();
    return move;
  }
  SimilarityMove move;
  move.translate = vector();
  if (one_in(2)) move.rotate = {vector(), 180.0 * number()};
  if (one_in(3)) move.scale.setConstant(above_zero());
  if (one_in(6)) move.scale.z() = above_zero();
  if (one_in(4)) move.pivot = vector();
  return move;
}

Mesh Choices::mesh() {
  Mesh mesh;
  switch (byte() % 5) {
    case 0:
      mesh = cylinder(8, 6, 0.5, 3.0);
      break;
    case 1:
      mesh = icosphere(1);
      break;
    case 2:
      mesh = grid(5, 5);
      break;
    case 3:
      mesh = torus(8, 5, 1.0, 0.4);
      break;
    default:
      mesh = bar(1, 6, 0.4, 3.0);
  }
  const auto count = static_cast<Index>(mesh.vertex_count());
  for (int spoilt = byte() % 12; spoilt > 8; --spoilt) {
    switch (byte() % 5) {
      case 0:  // a spike, or far away
        mesh.positions[below(count)] = vector();
        break;
      case 1:  // together
        mesh.positions[below(count)] = mesh.positions[below(count)];
        break;
      case 2:  // a triangle anywhere
        mesh.add_face(std::array{below(count), below(count), below(count)});
        break;
      case 3:  // loose
        mesh.positions.emplace_back(vector());
        break;
      default:
        mesh.positions[below(count)].x() = std::numeric_limits<double>::quiet_NaN();
    }
  }
  return mesh;
}

}  // namespace lapwing::fuzz
