#include "lapwing/mesh/transform.h"

#include <algorithm>
#include <numeric>

#include <Eigen/LU>

#include "lapwing/mesh/compact.h"

namespace lapwing {

using Eigen::Vector3d;

namespace {

void flip_all_faces(Mesh& mesh) {
  std::vector<Index> all(mesh.face_count());
  std::iota(all.begin(), all.end(), Index{0});
  flip_faces(mesh, all);
}

}  // namespace

void transform(Mesh& mesh, const Eigen::Affine3d& motion) {
  for (Vector3d& position : mesh.positions) position = motion * position;
  const double determinant = motion.linear().determinant();
  // A singular motion leaves no direction for normals, so they stay.
  if (determinant != 0.0) {
    const Eigen::Matrix3d turn = motion.linear().inverse().transpose();
    for (Vector3d& normal : mesh.edit_attributes().normals) {
      normal = (turn * normal).stableNormalized();
    }
  }
  mesh.source.reset();
  if (determinant < 0.0) flip_all_faces(mesh);
}

void flip_faces(Mesh& mesh, std::span<const Index> faces) {
  FaceSources sources;
  sources.starts = mesh.face_starts();
  sources.faces.resize(mesh.face_count());
  std::iota(sources.faces.begin(), sources.faces.end(), Index{0});
  sources.corners.resize(mesh.face_vertices().size());
  std::iota(sources.corners.begin(), sources.corners.end(), Index{0});
  for (const Index f : faces) {
    std::reverse(sources.corners.begin() + mesh.face_starts()[f] + 1,
                 sources.corners.begin() + mesh.face_starts()[f + 1]);
  }
  replace_faces(mesh, sources);
}

void turn_inside_out(Mesh& mesh) {
  flip_all_faces(mesh);
  for (Vector3d& normal : mesh.edit_attributes().normals) normal = -normal;
}

}  // namespace lapwing
