#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/io/number_table.h"
#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// Which numbers of a row are what.
struct PointColumns {
  std::array<std::size_t, 3> position{0, 1, 2};
  std::optional<std::array<std::size_t, 3>> normal = {};
  std::optional<std::array<std::size_t, 4>> rotation = {};  ///< w, x, y, z
};

/// A table whose rows are points, and what may change of it.
struct PointTable {
  NumberTable table;  ///< as it was read
  PointColumns columns;
  Positions positions;
  std::vector<Eigen::Vector3d> normals;       ///< one per point, or none
  std::vector<Eigen::Quaterniond> rotations;  ///< one per point, or none
};

/// Reads a table of points. A header that names the columns x, y and z says what they are, and so
/// do nx, ny, nz and qw, qx, qy, qz; other columns are kept as they are. Without such a header rows
/// have 3 numbers, the position, 6, and a normal, or 7, and a quaternion w, x, y, z. Throws what
/// `read_number_table` does, and InputError, naming the row, for rows of other lengths or of
/// different ones and for a position, normal or quaternion that is not finite.
PointTable read_point_table(const std::filesystem::path& path);

/// The file that `points` was read from with positions, normals and rotations as they are now; all
/// else keeps its bytes. Throws InputError for a NPY file of integers, unless nothing changed.
std::string bytes_of(const PointTable& points);

}  // namespace lapwing
