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

/// A correspondence as a person gave it: a point of the surface, and where it is to go.
struct TargetRow {
  /// A vertex, or the point of the ROI's surface that is nearest to a place.
  std::variant<Index, Eigen::Vector3d> point = Index{0};
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  double weight = 1.0;  ///< times the constraint weight; has no effect on hard targets
  std::optional<std::size_t> image_of = {};  ///< the row whose mirror image this one is, for errors
  bool operator==(const TargetRow&) const = default;
};

/// The landmarks of an edit (eq. 5 with any vertices and positions).
struct TargetSpec {
  std::vector<TargetRow> rows;
  /// Where a recipe's rows come from: a table that its step reads. `deform` itself opens no file
  /// and wants rows.
  std::filesystem::path file = {};
  bool hard = false;              ///< reached exactly, rather than in the least squares
  std::string where = "targets";  ///< as in RegionSpec; no part of the value

  bool empty() const { return rows.empty() && file.empty(); }
  bool operator==(const TargetSpec& other) const {
    return rows == other.rows && file == other.file && hard == other.hard;
  }
};

/// A row that is bound to a mesh.
struct Target {
  std::array<Index, 3> corners{};  ///< of a triangle of the ROI; all the same for a vertex
  std::array<double, 3> shares{};  ///< of the corners; {1, 0, 0} for a vertex
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  double weight = 1.0;

  bool is_vertex() const { return shares[0] == 1.0; }
  /// To the bit: a hard target's vertex goes to -0 or to 0.
  bool operator==(const Target& other) const {
    return corners == other.corners && shares == other.shares && weight == other.weight &&
           std::memcmp(position.data(), other.position.data(), sizeof position) == 0;
  }
};

/// Where its point is on a surface.
Eigen::Vector3d point_of(const Target& target, std::span<const Eigen::Vector3d> positions);

/// The vertices that have a share in any of them.
VertexSet corners_of(std::span<const Target> targets);

/// Rows of numbers as rows of targets: vertex, x, y, z, or with the point in place of the vertex
/// px, py, pz, x, y, z; the weight may follow. `where` and the row's number name an error.
TargetRow target_row(std::span<const double> numbers, const std::string& where);

/// Binds the rows to the mesh, in their order. A row that says what an earlier one said is passed
/// over. Throws InputError, naming the row from 0: a number that is not finite, a weight that is
/// not above 0, a vertex that the mesh does not have, that is outside the ROI, that `held` (belt
/// and handles) has too, or that is in two rows with different positions.
std::vector<Target> resolve_targets(const TargetSpec& spec, const VertexSet& roi,
                                    const VertexSet& held, const Mesh& mesh);

}  // namespace lapwing
