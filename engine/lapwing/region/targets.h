#pragma once

#include <array>
#include <cstring>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "lapwing/mesh/mesh.h"
#include "lapwing/region/vertex_set.h"

namespace lapwing {

/// A target as the user defined it: a point of the surface and its target position.
struct TargetRow {
  /// A vertex, or a position that selects the nearest point of the ROI's surface.
  std::variant<Index, Eigen::Vector3d> point = Index{0};
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  double weight = 1.0;  ///< factor on the constraint weight; no effect on hard targets
  std::optional<std::size_t> image_of = {};  ///< row that this row mirrors, for messages
  bool operator==(const TargetRow&) const = default;
};

/// The landmarks of an edit (eq. 5 with any vertices and positions).
struct TargetSpec {
  std::vector<TargetRow> rows = {};
  /// Table from which a recipe step reads the rows. `deform` opens no file; it uses only `rows`.
  std::filesystem::path file = {};
  bool hard = false;              ///< reached exactly instead of in the least-squares sense
  std::string where = "targets";  ///< as in RegionSpec; ignored by ==

  bool empty() const { return rows.empty() && file.empty(); }
  bool operator==(const TargetSpec& other) const {
    return rows == other.rows && file == other.file && hard == other.hard;
  }
};

/// A row resolved on a mesh.
struct Target {
  std::array<Index, 3> corners{};  ///< corners of a triangle of the ROI; all equal for a vertex
  std::array<double, 3> shares{};  ///< barycentric coordinates; {1, 0, 0} for a vertex
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  double weight = 1.0;

  bool is_vertex() const { return shares[0] == 1.0; }
  /// Compares positions bitwise, because a hard target distinguishes -0 from 0.
  bool operator==(const Target& other) const {
    return corners == other.corners && shares == other.shares && weight == other.weight &&
           std::memcmp(position.data(), other.position.data(), sizeof position) == 0;
  }
};

/// Returns the position of the target's point on a surface.
Eigen::Vector3d point_of(const Target& target, std::span<const Eigen::Vector3d> positions);

/// Returns the vertices with a nonzero barycentric coordinate in a target.
VertexSet corners_of(std::span<const Target> targets);

/// Converts a row of numbers: either vertex, x, y, z or, with a point instead of a vertex, px, py,
/// pz, x, y, z. A weight may follow. Throws InputError, naming `where`, for any other row.
TargetRow target_row(std::span<const double> numbers, const std::string& where);

/// Resolves the rows on the mesh, in their order. Skips a row that repeats both vertex and position
/// of an earlier row. Throws InputError, naming the row (counted from 0), if a number is not
/// finite, a weight is outside its range, the ROI has no triangle for a point, or a vertex does not
/// exist, is outside the ROI, is in `held` (belt and handles), or has another position in an
/// earlier row.
std::vector<Target> resolve_targets(const TargetSpec& spec, const VertexSet& roi,
                                    const VertexSet& held, const Mesh& mesh);

}  // namespace lapwing
