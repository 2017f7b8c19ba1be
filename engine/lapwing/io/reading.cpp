#include "lapwing/io/reading.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/printable_text.h"
#include "lapwing/mesh/compact.h"

namespace lapwing {

std::vector<std::string> Tally::lines() const {
  std::vector<std::string> lines;
  for (const auto& [name, count] : counts_) lines.push_back(name + " (" + grouped(count) + ")");
  return lines;
}

std::vector<Eigen::Vector4f> unit_colors(const std::vector<Eigen::Vector4d>& colors) {
  constexpr double kClearlyAboveOne = 1.5;
  const auto is_byte = [](double x) { return x > kClearlyAboveOne; };
  bool bytes = false;
  for (const Eigen::Vector4d& color : colors) {
    bytes = bytes || is_byte(color[0]) || is_byte(color[1]) || is_byte(color[2]);
  }
  const double scale = bytes ? 1.0 / 255.0 : 1.0;
  std::vector<Eigen::Vector4f> result;
  result.reserve(colors.size());
  for (const Eigen::Vector4d& color : colors) {
    result.emplace_back(color.unaryExpr(
        [&](double x) { return std::isnan(x) ? 1.0F : static_cast<float>(scale * x); }));
  }
  return result;
}

void close_face(const SourceFile& file, Faces& faces, std::uint64_t offset) {
  if (faces.vertices.size() >= kNoIndex) {
    file.fail(offset, "the mesh has more than 4,294,967,294 face corners");
  }
  faces.starts.push_back(static_cast<Index>(faces.vertices.size()));
}

std::uint64_t start_of_last_line(const SourceFile& file) {
  const std::size_t last = file.bytes().find_last_not_of(" \t\r\n");
  const std::size_t line_end = file.bytes().find_last_of("\r\n", last);
  return line_end == std::string_view::npos ? 0 : line_end + 1;
}

void FaceDefects::report(FileDefectKind kind, std::uint64_t offset, std::size_t face,
                         const std::string& message) {
  if (!faces_.empty() && faces_.back() == face) return;
  file_.report_defect(kind, offset, message);
  faces_.push_back(face);
}

void FaceDefects::report_short(std::uint64_t offset, std::size_t face, std::size_t corners) {
  report(FileDefectKind::short_face, offset, face,
         "a face needs at least 3 corners, but this one has " + std::to_string(corners));
}

void FaceDefects::report_vertex(std::uint64_t offset, std::size_t face, std::int64_t vertex,
                                std::size_t vertex_count) {
  report(FileDefectKind::missing_vertex, offset, face,
         "face " + std::to_string(face) + " names vertex " + std::to_string(vertex) +
             ", but the file has " + std::to_string(vertex_count) + " (numbered from 0)");
}

void FaceDefects::drop_faces(Mesh& mesh) const {
  if (faces_.empty()) return;
  KeepMask keep(mesh.face_count(), 1);
  for (const std::size_t face : faces_) keep[face] = 0;
  keep_faces(mesh, keep);
}

}  // namespace lapwing
