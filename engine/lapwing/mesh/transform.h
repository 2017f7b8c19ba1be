#pragma once

#include <span>

#include <Eigen/Geometry>

#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// Applies `motion` to the positions, and its inverse transpose to stored normals. A motion that
/// mirrors also flips the faces, so that the outside stays outside. Resets `mesh.source`.
void transform(Mesh& mesh, const Eigen::Affine3d& motion);

/// Reverses the corners of `faces` except the first, so that a convex polygon is still cut as a fan
/// of that corner. Stored normals stay as they are. Resets `mesh.source`.
void flip_faces(Mesh& mesh, std::span<const Index> faces);

/// Turns the whole surface inside out: faces and stored normals.
void turn_inside_out(Mesh& mesh);

}  // namespace lapwing
