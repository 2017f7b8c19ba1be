#include "lapwing/io/reading.h"

#include <cmath>

#include "lapwing/base/grouped.h"

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

void fail_vertex(const SourceFile& file, std::uint64_t offset, std::size_t face,
                 std::int64_t vertex, std::size_t vertex_count) {
  file.fail(offset, "face " + std::to_string(face) + " names vertex " + std::to_string(vertex) +
                        ", but the file has " + std::to_string(vertex_count) +
                        " (numbered from 0)");
}

}  // namespace lapwing
