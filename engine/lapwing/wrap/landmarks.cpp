// The pages "Markups" and "Coordinate systems" of 3D Slicer's documentation describe its files.
#include "lapwing/wrap/landmarks.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>

#include "lapwing/base/errors.h"
#include "lapwing/io/atomic_file.h"
#include "lapwing/io/file_bytes.h"
#include "lapwing/io/point_table.h"
#include "lapwing/io/text_scanner.h"
#include "lapwing/io/writing.h"
#include "lapwing/mesh/closest_point.h"

namespace lapwing {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;

// A position on the template may be at most this fraction of the diagonal away from the surface.
constexpr double kFarthest = 0.01;

// A point of a file that contains the points of one surface.
struct LabeledPoint {
  std::string label;
  Vector3d position;
  std::string where;
};

std::string in_quotes(std::string_view text) {
  return '"' + std::string(text) + '"';
}

Landmark landmark_of(std::span<const double> numbers, const std::string& where) {
  if (numbers.size() == 2) {
    const auto is_vertex = [](double v) {
      return v >= 0.0 && v == std::floor(v) && v < static_cast<double>(kNoIndex);
    };
    if (!std::ranges::all_of(numbers, is_vertex)) {
      throw InputError(where +
                       ": a row of two numbers contains a vertex of the template and a vertex of "
                       "the scan, counted from 0; correct them");
    }
    return {static_cast<Index>(numbers[0]), static_cast<Index>(numbers[1]), 1.0, where};
  }
  const TargetRow row = target_row(numbers, where);
  return {row.point, row.position, row.weight, where};
}

std::vector<Landmark> read_list(const JsonNode& list) {
  std::vector<Landmark> rows;
  for (const JsonNode& row : list.elements()) rows.push_back(read_landmark(row));
  return rows;
}

std::vector<Landmark> read_rows(const fs::path& path) {
  const std::string name = lowered(path.filename().string());
  if (name.ends_with(".fcsv") || name.ends_with(".mrk.json")) {
    throw InputError(path.string() +
                     ": a file of 3D Slicer contains the points of one surface; give two files, "
                     "those of the template and of the scan");
  }
  if (name.ends_with(".json")) {
    return read_list(JsonNode::parse(FileBytes::read(path).view(), path.string()));
  }
  const NumberTable table = read_number_table(path);
  const NumberColumns columns = number_columns(table);
  std::vector<Landmark> rows;
  for (std::size_t r = 0; r < table.row_count(); ++r) {
    rows.push_back(landmark_of(columns.of_row(table, r), table.place(r)));
  }
  return rows;
}

// Returns whether points are in the coordinate system RAS, which is LPS rotated by 180 degrees
// about z.
bool is_ras(const std::string& system, const std::string& where) {
  const std::string name = lowered(system);
  if (name == "ras" || name == "0") return true;
  if (name == "lps" || name == "1" || name.empty()) return false;
  throw InputError(where + ": expected the coordinate system LPS or RAS, got " + in_quotes(system) +
                   "; save the points in LPS");
}

void convert_to_lps(Vector3d& point) {
  point.head<2>() *= -1.0;
}

std::vector<LabeledPoint> read_markups(const fs::path& path) {
  std::vector<LabeledPoint> points;
  const JsonNode root = JsonNode::parse(FileBytes::read(path).view(), path.string());
  for (const JsonNode& markup : root.at("markups").elements()) {
    const auto system = markup.find("coordinateSystem");
    const bool converts = system && is_ras(system->string(), system->where());
    const auto controls = markup.find("controlPoints");
    if (!controls) continue;
    for (const JsonNode& control : controls->elements()) {
      const auto position = control.find("position");
      // 3D Slicer saves "" as the position of a control point that has no position.
      if (!position || position->is_string()) continue;
      const auto label = control.find("label");
      points.push_back({label ? label->string() : "", position->vector3(), control.where()});
      if (converts) convert_to_lps(points.back().position);
    }
  }
  return points;
}

// Returns the value of the comment "# CoordinateSystem = LPS", or an empty string.
std::string stated_system(std::string_view text) {
  constexpr std::string_view kKey = "# CoordinateSystem";
  const std::size_t at = text.find(kKey);
  if (at == std::string_view::npos) return {};
  text.remove_prefix(at + kKey.size());
  text = text.substr(0, text.find_first_of("\r\n"));
  text.remove_prefix(std::min(text.find_first_not_of(" =\t"), text.size()));
  return std::string(text.substr(0, text.find_last_not_of(" \t") + 1));
}

std::string label_in(const NumberTable& table, std::size_t row, std::size_t column) {
  if (column >= table.row(row).size()) return {};
  if (const auto text = table.text_at(row, column)) return std::string(*text);
  std::ostringstream number;
  number << table.row(row)[column];
  return number.str();
}

std::vector<LabeledPoint> read_point_rows(const fs::path& path) {
  const PointTable read = read_point_table(path);
  const NumberTable& table = read.table;
  const auto has = [&](std::string_view name) {
    return std::ranges::count(table.header, name) > 0;
  };
  const bool converts = is_ras(stated_system(table.bytes->view()), table.name) ||
                        (has("r") && has("a") && has("s") && !has("x"));
  auto labels = std::ranges::find(table.header, "label");
  if (labels == table.header.end()) labels = std::ranges::find(table.header, "name");
  const auto column = static_cast<std::size_t>(labels - table.header.begin());
  std::vector<LabeledPoint> points;
  for (std::size_t r = 0; r < table.row_count(); ++r) {
    points.push_back({labels == table.header.end() ? "" : label_in(table, r, column),
                      read.positions[r], table.place(r)});
    if (converts) convert_to_lps(points.back().position);
  }
  return points;
}

std::vector<LabeledPoint> read_points(const fs::path& path) {
  const bool is_markups = lowered(path.filename().string()).ends_with(".mrk.json");
  std::vector<LabeledPoint> points = is_markups ? read_markups(path) : read_point_rows(path);
  if (points.empty()) {
    throw InputError(path.string() +
                     ": the file contains no points; place some, and save it again");
  }
  return points;
}

bool has_label(const LabeledPoint& point) {
  return !point.label.empty();
}

std::map<std::string, const LabeledPoint*> by_label(std::span<const LabeledPoint> points) {
  std::map<std::string, const LabeledPoint*> found;
  for (const LabeledPoint& point : points) {
    if (!has_label(point)) {
      throw InputError(point.where + ": the point has no label, but other points have one; add it");
    }
    const auto [at, is_new] = found.emplace(point.label, &point);
    if (!is_new) {
      throw InputError(point.where + ": the label " + in_quotes(point.label) +
                       " is also that of another point (" + at->second->where +
                       "); rename one of the two");
    }
  }
  return found;
}

void note_unpaired(const std::vector<std::string>& labels, const fs::path& other,
                   std::vector<std::string>& notes) {
  if (labels.empty()) return;
  std::string list;
  for (const std::string& label : labels) list += (list.empty() ? "" : ", ") + in_quotes(label);
  notes.push_back(other.string() + " has no points labeled " + list +
                  ", so the points with these labels in the other file have no effect");
}

// Pairs the points of two files by their labels, or in order if no point has one.
std::vector<Landmark> read_pairs(const fs::path& file, const fs::path& scan_file,
                                 std::vector<std::string>& notes) {
  const std::vector<LabeledPoint> ours = read_points(file);
  const std::vector<LabeledPoint> theirs = read_points(scan_file);
  std::vector<Landmark> rows;
  if (std::ranges::none_of(ours, has_label) && std::ranges::none_of(theirs, has_label)) {
    if (ours.size() != theirs.size()) {
      throw InputError(file.string() + " contains " + std::to_string(ours.size()) + " points and " +
                       scan_file.string() + " " + std::to_string(theirs.size()) +
                       ". Points without labels correspond in order; label them, or place the "
                       "same number of points");
    }
    for (std::size_t k = 0; k < ours.size(); ++k) {
      rows.push_back({ours[k].position, theirs[k].position, 1.0, ours[k].where});
    }
    return rows;
  }
  by_label(ours);
  auto left = by_label(theirs);
  std::vector<std::string> unpaired;
  for (const LabeledPoint& point : ours) {
    const auto at = left.find(point.label);
    if (at == left.end()) {
      unpaired.push_back(point.label);
      continue;
    }
    rows.push_back({point.position, at->second->position, 1.0, point.where, point.label});
    left.erase(at);
  }
  if (rows.empty()) {
    throw InputError(file.string() + " and " + scan_file.string() + " have no label in common (" +
                     in_quotes(ours.front().label) + ", " + in_quotes(theirs.front().label) +
                     "); give corresponding points the same label");
  }
  note_unpaired(unpaired, scan_file, notes);
  unpaired.clear();
  for (const auto& [label, point] : left) unpaired.push_back(label);
  note_unpaired(unpaired, file, notes);
  return rows;
}

// Returns the prefix of messages about a landmark.
std::string place_of(const Landmark& row) {
  return row.label.empty() ? row.where : row.where + ": point " + in_quotes(row.label);
}

Index checked(Index v, const Mesh& mesh, const char* name, const std::string& where) {
  if (v < mesh.vertex_count()) return v;
  throw InputError(where + ": the " + name + " has no vertex " + std::to_string(v) +
                       ", only 0 to " + std::to_string(mesh.vertex_count() - 1) +
                       "; correct the number",
                   {v});
}

void require_near(const Vector3d& point, const ClosestPoint& surface, double diagonal,
                  const std::string& where) {
  const double distance = (surface.find(0, point).position - point).norm();
  if (!(distance > kFarthest * diagonal)) return;
  std::ostringstream text;
  text << where << ": the position (" << point.x() << ", " << point.y() << ", " << point.z()
       << ") is " << distance << " away from the template, but landmarks must be within "
       << kFarthest * diagonal
       << ", a hundredth of its diagonal. Check that the landmarks were placed on this mesh, in "
          "the same unit and coordinate "
          "system (3D Slicer: save the mesh in LPS)";
  throw InputError(text.str());
}

}  // namespace

Landmark read_landmark(const JsonNode& json) {
  if (!json.is_object()) return landmark_of(json.numbers(), json.where());
  json.require_keys({"vertex", "point", "position", "scan_vertex", "weight", "label"});
  Landmark row{.where = json.where()};
  if (json.only_key_of({"vertex", "point"}, "a landmark on the template") == "vertex") {
    row.on_template = json.at("vertex").vertex();
  } else {
    row.on_template = json.at("point").vector3();
  }
  if (json.only_key_of({"position", "scan_vertex"}, "a landmark on the scan") == "position") {
    row.on_scan = json.at("position").vector3();
  } else {
    row.on_scan = json.at("scan_vertex").vertex();
  }
  if (const auto weight = json.find("weight")) row.weight = weight->positive_number();
  if (const auto label = json.find("label")) row.label = label->string();
  return row;
}

LandmarkSpec with_rows(LandmarkSpec spec, const fs::path& base_directory,
                       std::vector<std::string>& notes) {
  if (spec.file.empty()) return spec;
  const fs::path file = base_directory / spec.file;
  spec.rows = spec.scan_file.empty() ? read_rows(file)
                                     : read_pairs(file, base_directory / spec.scan_file, notes);
  spec.where = file.string();
  return spec;
}

TargetSpec targets_of(const LandmarkSpec& spec, const Mesh& wrapped, const Mesh& scan) {
  TargetSpec targets{.where = spec.where};
  const std::vector<Triangle>& triangles = wrapped.topology().triangles;
  const double diagonal = bounds_of(wrapped.positions).diagonal();
  std::optional<ClosestPoint> surface;
  for (const Landmark& row : spec.rows) {
    if (const auto* v = std::get_if<Index>(&row.on_template)) {
      checked(*v, wrapped, "template", place_of(row));
    } else if (!triangles.empty()) {
      if (!surface) surface.emplace(triangles, wrapped.positions);
      require_near(std::get<Vector3d>(row.on_template), *surface, diagonal, place_of(row));
    }
    const auto* v = std::get_if<Index>(&row.on_scan);
    const Vector3d position = v != nullptr
                                  ? scan.positions[checked(*v, scan, "scan", place_of(row))]
                                  : std::get<Vector3d>(row.on_scan);
    targets.rows.push_back({row.on_template, position, row.weight});
  }
  return targets;
}

void write_landmarks(std::span<const TargetRow> rows, const Mesh& wrapped, const fs::path& path) {
  const bool has_positions = std::ranges::any_of(
      rows, [](const TargetRow& row) { return std::holds_alternative<Vector3d>(row.point); });
  std::string text = has_positions ? "px,py,pz,x,y,z,weight\n" : "vertex,x,y,z,weight\n";
  const auto append = [&text](const Vector3d& numbers) {
    for (const double number : numbers) {
      append_number(text, number);
      text += ',';
    }
  };
  for (const TargetRow& row : rows) {
    const auto* v = std::get_if<Index>(&row.point);
    if (has_positions) {
      append(v != nullptr ? wrapped.positions[*v] : std::get<Vector3d>(row.point));
    } else {
      text += std::to_string(*v) + ',';
    }
    append(row.position);
    append_number(text, row.weight);
    text += '\n';
  }
  replace_file(path, text);
}

}  // namespace lapwing
