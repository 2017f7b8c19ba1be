#include "lapwing/deform/handle_motion.h"

#include <algorithm>

#include "lapwing/laplacian/rotation.h"

namespace lapwing {

bool HandleMotions::any_free() const {
  return std::ranges::any_of(is_free, [](char free) { return free != 0; });
}

HandleMotions handle_motions(std::span<const Eigen::Affine3d> maps) {
  HandleMotions motions;
  motions.maps.assign(maps.begin(), maps.end());
  for (const Eigen::Affine3d& map : maps) motions.turns.push_back(shortest_turn(map));
  return motions;
}

HandleFrame handle_frame(std::span<const Index> vertices,
                         std::span<const Eigen::Vector3d> positions) {
  HandleFrame frame;
  if (vertices.empty()) return frame;
  // Coordinates relative to the first vertex avoid a loss of precision far from the origin.
  const Eigen::Vector3d origin = positions[vertices.front()];
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Index v : vertices) sum += positions[v] - origin;
  frame.centroid = origin + sum / static_cast<double>(vertices.size());
  double radius = 0.0;
  for (const Index v : vertices) radius = std::max(radius, (positions[v] - frame.centroid).norm());
  frame.extent = radius;
  if (radius > 0.0) frame.radius = radius;
  return frame;
}

void motion_parameters(const HandleFrame& frame, const Eigen::Affine3d& motion,
                       std::span<double> parameters) {
  const Eigen::Matrix3d D = motion.linear() - Eigen::Matrix3d::Identity();
  // D c + t is exact for a pure translation; motion(c) - c is not if the mesh is far from the
  // origin.
  const Eigen::Vector3d at_centroid = D * frame.centroid + motion.translation();
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) {
      parameters[static_cast<std::size_t>(4 * a + b)] = D(a, b) * frame.radius;
    }
    parameters[static_cast<std::size_t>(4 * a + 3)] = at_centroid(a);
  }
}

Eigen::Vector3d handle_displacement(const HandleFrame& frame, std::span<const double> parameters,
                                    const Eigen::Vector3d& position) {
  using Motion = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;
  const Eigen::Map<const Motion> motion(parameters.data());
  return motion.leftCols<3>() * ((position - frame.centroid) / frame.radius) + motion.col(3);
}

Eigen::AngleAxisd shortest_turn(const Eigen::Affine3d& motion) {
  return Eigen::AngleAxisd(nearest_rotation(motion.linear()));
}

Eigen::Affine3d partial_motion(const Eigen::Affine3d& motion, const Eigen::AngleAxisd& turn,
                               const Eigen::Vector3d& centroid, double share) {
  const Eigen::Matrix3d stretch = turn.toRotationMatrix().transpose() * motion.linear();
  Eigen::Affine3d part = Eigen::Affine3d::Identity();
  part.linear() = Eigen::AngleAxisd(share * turn.angle(), turn.axis()) *
                  ((1.0 - share) * Eigen::Matrix3d::Identity() + share * stretch);
  const Eigen::Vector3d place = centroid + share * (motion * centroid - centroid);
  part.translation() = place - part.linear() * centroid;
  return part;
}

Eigen::Affine3d turned_to(const Eigen::Affine3d& map, const Eigen::Vector3d& centroid,
                          const Eigen::Matrix3d& rotation) {
  Eigen::Affine3d turned = map;
  turned.linear() = rotation * (nearest_rotation(map.linear()).transpose() * map.linear());
  turned.translation() = map * centroid - turned.linear() * centroid;
  return turned;
}

}  // namespace lapwing
