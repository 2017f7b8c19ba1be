#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/io/number_table.h"
#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// Columns of the values of a point.
struct PointColumns {
  std::array<std::size_t, 3> position{0, 1, 2};
  std::optional<std::array<std::size_t, 3>> normal = {};
  std::optional<std::array<std::size_t, 4>> rotation = {};  ///< w, x, y, z
};

/// A table whose rows are points, with the values that an edit may change.
struct PointTable {
  NumberTable table;  ///< as it was read
  PointColumns columns;
  Positions positions;
  std::vector<Eigen::Vector3d> normals;       ///< one per point, or none
  std::vector<Eigen::Quaterniond> rotations;  ///< one per point, or none
};

/// Reads a table of points. A header with the names x, y and z defines the columns. 3D Slicer
/// exports the names r, a, s or l, p, s instead. Optional names are nx, ny, nz for a normal and qw,
/// qx, qy, qz for a quaternion. Other columns may have any content.
///
/// If the header does not name the columns, each row has 3, 6 or 7 numbers. They are a position,
/// optionally followed by a normal or a quaternion w, x, y, z. Text may only precede or follow
/// these numbers.
///
/// Throws what `read_number_table` and `number_columns` throw. Throws InputError, naming the row,
/// if a row has a wrong length or if a position, normal or quaternion is not finite.
PointTable read_point_table(const std::filesystem::path& path);

/// Returns the file of `points` with their current positions, normals and rotations; all else keeps
/// its bytes. Throws InputError if numbers of a .npy file of integers changed.
std::string bytes_of(const PointTable& points);

}  // namespace lapwing
