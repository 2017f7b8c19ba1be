#pragma once

#include <span>

#include <Eigen/Geometry>

#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// Moves all of `mesh`: positions by `motion`, stored normals as those of the surface. A motion
/// that mirrors turns the faces over, so that what was outside stays outside. Resets `mesh.source`.
void transform(Mesh& mesh, const Eigen::Affine3d& motion);

/// Runs through `faces` the other way, from the same first corner on: a convex polygon is cut as
/// the fan of that corner. Stored normals stay as they are. Resets `mesh.source`.
void flip_faces(Mesh& mesh, std::span<const Index> faces);

/// Turns the whole surface inside out: faces and stored normals.
void turn_inside_out(Mesh& mesh);

}  // namespace lapwing
