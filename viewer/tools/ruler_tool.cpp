#include "tools/ruler_tool.h"

#include <array>
#include <cmath>
#include <cstdio>

#include "lapwing/region/geodesic.h"

namespace lapwing::viewer {
namespace {

using Eigen::Vector3d;

// The cursor moves less than this during a click.
constexpr double kDragPt = 4.0;

double length_of(std::span<const Vector3d> line) {
  double length = 0.0;
  for (std::size_t k = 1; k < line.size(); ++k) length += (line[k] - line[k - 1]).norm();
  return length;
}

}  // namespace

ToolAnswer RulerTool::handle(const InputEvent& event, const ToolScene& scene) {
  const bool of_left = event.button == MouseButton::left;
  if (event.kind == InputKind::press && of_left) return begin(event, scene);
  if (event.kind == InputKind::key && event.key == kEscape && from_ != kNoIndex) {
    reset();
    return ToolAnswer::only_taken();
  }
  if (!is_pressed_) return ToolAnswer::passed_on();
  if (event.kind == InputKind::move) return ToolAnswer::only_taken();
  if (event.kind != InputKind::release || !of_left) return ToolAnswer::passed_on();
  is_pressed_ = false;
  const double way = (event.position - pressed_).norm();
  if (has_both_ends() || way <= scene.projection.in_pixels(kDragPt)) {
    return ToolAnswer::only_taken();
  }
  const auto pick = scene.pick(event.position);
  return pick ? end(pick->vertex, scene) : ToolAnswer::only_taken();
}

ToolAnswer RulerTool::begin(const InputEvent& event, const ToolScene& scene) {
  const auto pick = scene.pick(event.position);
  if (!pick) return ToolAnswer::passed_on();
  ToolAnswer answer = ToolAnswer::only_taken();
  const bool is_second = from_ != kNoIndex && !has_both_ends();
  if (is_second) {
    answer = end(pick->vertex, scene);
  } else {
    reset();
    from_ = pick->vertex;
    topology_ = surface_of(scene.state)->shared_topology();
  }
  pressed_ = event.position;
  is_pressed_ = true;
  return answer;
}

ToolAnswer RulerTool::end(Index vertex, const ToolScene& scene) {
  if (vertex == from_) return ToolAnswer::only_taken();
  std::vector<Index> path = shortest_edge_path(*topology_, scene.positions, from_, vertex);
  if (path.empty()) {
    return {true, {}, "No path on the surface leads there. Click a point on the same component."};
  }
  to_ = vertex;
  path_ = std::move(path);
  measure_along_path(*topology_, scene.positions);
  return ToolAnswer::only_taken();
}

void RulerTool::measure_along_path(const Topology& topology, std::span<const Vector3d> positions) {
  line_.clear();
  for (const Index v : path_) line_.push_back(positions[v]);
  measured_length_ = length_of(line_);
  straight_ = (positions[to_] - positions[from_]).norm();
  // The geodesic is at most as long as the edge path, up to rounding.
  constexpr double kRounding = 1e-9;
  const double most = (1.0 + kRounding) * measured_length_;
  const double geodesic = geodesic_distances(topology, positions, {&from_, 1}, most)[to_];
  measured_along_ = along_ = std::isfinite(geodesic) ? geodesic : measured_length_;
}

void RulerTool::follow(const std::shared_ptr<const Topology>& topology,
                       std::span<const Vector3d> positions, bool still) {
  if (from_ == kNoIndex) return;
  if (topology != topology_) return reset();
  if (!has_both_ends()) return;
  for (std::size_t k = 0; k < path_.size(); ++k) line_[k] = positions[path_[k]];
  const double length = length_of(line_);
  straight_ = (positions[to_] - positions[from_]).norm();
  if (length == measured_length_) {
    along_ = measured_along_;
  } else if (still) {
    path_ = shortest_edge_path(*topology, positions, from_, to_);
    measure_along_path(*topology, positions);
  } else {
    along_ = measured_length_ > 0.0 ? measured_along_ * length / measured_length_ : length;
  }
}

void RulerTool::read_out(std::string& text) const {
  std::array<char, 96> words{};
  std::snprintf(words.data(), words.size(), "Straight %.5g, along the surface %.5g", straight_,
                along_);
  text = words.data();
}

const char* RulerTool::hint(const AppState&, const Part&) const {
  if (has_both_ends())
    return "Click a point to start another measurement. Escape removes this one.";
  return from_ == kNoIndex ? "Click two points on the surface to measure their distance."
                           : "Click the second point.";
}

ToolMarks RulerTool::marks() const {
  if (from_ == kNoIndex || has_both_ends()) return {};
  return {.dots = {from_}};
}

}  // namespace lapwing::viewer
