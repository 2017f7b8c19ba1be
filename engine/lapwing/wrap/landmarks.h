#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "lapwing/json/json_node.h"
#include "lapwing/mesh/mesh.h"
#include "lapwing/region/targets.h"

namespace lapwing {

/// A point of the template and the corresponding point of the scan.
struct Landmark {
  /// A vertex or a position. The position on the template selects the closest point of its surface.
  using Point = std::variant<Index, Eigen::Vector3d>;
  Point on_template = Index{0};
  Point on_scan = Index{0};
  double weight = 1.0;
  std::string where = "landmarks";  ///< prefix of messages; ignored by ==
  std::string label = {};           ///< for messages; ignored by ==

  bool operator==(const Landmark& other) const {
    return on_template == other.on_template && on_scan == other.on_scan && weight == other.weight;
  }
};

/// The landmarks of a recipe or a command: rows, a file of rows, or two files of points.
struct LandmarkSpec {
  std::vector<Landmark> rows = {};
  std::filesystem::path file = {};  ///< path as in the recipe
  /// If not empty, this file contains the points on the scan, and `file` those on the template.
  std::filesystem::path scan_file = {};
  std::string where = "landmarks";  ///< prefix of messages; ignored by ==

  bool empty() const { return rows.empty() && file.empty(); }
  bool operator==(const LandmarkSpec& other) const {
    return rows == other.rows && file == other.file && scan_file == other.scan_file;
  }
};

/// Reads a landmark: a row of numbers, or an object with "vertex" or "point" for the template,
/// "position" or "scan_vertex" for the scan, and optionally "weight" and "label". A row is vertex,
/// x, y, z; or px, py, pz, x, y, z for the point of the template closest to p; or the numbers of
/// two vertices. A weight may follow the positions. Throws InputError, naming the JSON pointer.
Landmark read_landmark(const JsonNode& json);

/// Reads the files of `spec`, whose paths are relative to `base_directory`, and returns `spec` with
/// their rows. A .json file is a list of landmarks as for `read_landmark`; other files are tables
/// of such rows.
///
/// Two files contain points, each with an optional label: .fcsv and .mrk.json of 3D Slicer, or
/// tables as for `read_point_table` with a column "label" or "name". If they have labels, points
/// with equal labels correspond, and a note names the others. Without labels, they correspond in
/// order. Points in Slicer's RAS coordinates are converted to LPS, in which Slicer saves meshes.
///
/// Throws IoError. Throws InputError, naming the file and the row, if a row is malformed or if the
/// points of two files do not correspond.
LandmarkSpec with_rows(LandmarkSpec spec, const std::filesystem::path& base_directory,
                       std::vector<std::string>& notes);

/// Returns the rows of `spec` with their positions on the scan. Throws InputError, naming the row,
/// if a vertex does not exist or if a position on the template is farther from the surface than a
/// hundredth of its diagonal.
TargetSpec targets_of(const LandmarkSpec& spec, const Mesh& wrapped, const Mesh& scan);

/// Writes the result of `targets_of` to a .csv file that `with_rows` reads: vertex, x, y, z,
/// weight. If a row contains a position on the template, all rows begin with px, py, pz instead of
/// the vertex. Throws IoError.
void write_landmarks(std::span<const TargetRow> rows, const Mesh& wrapped,
                     const std::filesystem::path& path);

}  // namespace lapwing
