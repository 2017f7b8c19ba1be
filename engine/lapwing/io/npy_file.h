#pragma once

#include <span>
#include <string>

#include <Eigen/Core>

#include "lapwing/io/mesh_format.h"

namespace lapwing {

/// Returns a .npy file (version 1.0) of an array of shape (rows.size(), 3), little endian, in C
/// order. `type` is float32 or float64.
std::string npy_bytes(std::span<const Eigen::Vector3d> rows, Scalar type);

}  // namespace lapwing
