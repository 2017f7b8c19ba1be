#include "tools/loop_tool.h"

#include "lapwing/base/errors.h"
#include "lapwing/region/geodesic.h"

namespace lapwing::viewer {
namespace {

constexpr double kClosingPt = 10.0;
constexpr std::size_t kFewestCorners = 3;

std::vector<Index> path(Index from, Index to, const ToolScene& scene) {
  return shortest_edge_path(surface_of(scene.state)->topology(), scene.positions, from, to);
}

}  // namespace

ToolAnswer LoopTool::handle(const InputEvent& event, const ToolScene& scene) {
  if (event.kind == InputKind::press && event.button == MouseButton::left) {
    return click(event, scene);
  }
  if (event.kind == InputKind::move) {
    hover(event.position, scene);
    return ToolAnswer::passed_on();
  }
  if (event.kind != InputKind::key || corners_.empty()) return ToolAnswer::passed_on();
  if (event.key == kEscape) {
    reset();
  } else if (event.key == kBackspace) {
    take_back();
  } else if (event.key == kEnter && !closed_) {
    return close(scene);
  } else {
    return ToolAnswer::passed_on();
  }
  return ToolAnswer::only_taken();
}

const char* LoopTool::hint(const AppState&, const Part& part) const {
  if (closed_) return "Click the side to keep.";
  if (!corners_.empty()) {
    return "Click more points. Enter or a click on the first point closes the loop.";
  }
  return of_part(part, "Click points around the region.",
                 "Click points around the vertices to hold in place.",
                 "Click points around a handle, inside the region.");
}

ToolMarks LoopTool::marks() const {
  return {.line = line(), .line_is_done = closed_, .dots = corners_};
}

ToolAnswer LoopTool::click(const InputEvent& event, const ToolScene& scene) {
  if (!closed_ && is_first(event.position, scene)) return close(scene);
  const auto pick = scene.pick(event.position);
  if (!pick) return ToolAnswer::passed_on();
  return closed_ ? choose_side(pick->vertex, scene) : add(pick->vertex, scene);
}

ToolAnswer LoopTool::add(Index corner, const ToolScene& scene) {
  if (!corners_.empty()) {
    if (corner == corners_.back()) return ToolAnswer::only_taken();
    std::vector<Index> piece = path(corners_.back(), corner, scene);
    if (piece.empty())
      return {true, {}, "No path on the surface leads there. Click on the same component."};
    pieces_.push_back(std::move(piece));
  }
  corners_.push_back(corner);
  to_cursor_.clear();
  return ToolAnswer::only_taken();
}

ToolAnswer LoopTool::close(const ToolScene& scene) {
  if (corners_.size() < kFewestCorners) {
    return {true, {}, "A loop needs at least three points. Click more points."};
  }
  pieces_.push_back(path(corners_.back(), corners_.front(), scene));
  closed_ = true;
  to_cursor_.clear();
  return ToolAnswer::only_taken();
}

ToolAnswer LoopTool::choose_side(Index inside, const ToolScene& scene) {
  const RegionSpec spec{LoopRegion{corners_, inside}, "loop"};
  try {
    // Tests the loop on the visible surface, because the command will use that.
    Mesh seen = *surface_of(scene.state);
    seen.positions.assign(scene.positions.begin(), scene.positions.end());
    (void)resolve(spec, seen);
  } catch (const InputError& error) {
    return {true, {}, error.what()};
  }
  reset();
  return {true, Choose{scene.part, spec}, {}};
}

void LoopTool::take_back() {
  if (closed_) {
    closed_ = false;
  } else {
    corners_.pop_back();
  }
  if (!pieces_.empty()) pieces_.pop_back();
  to_cursor_.clear();
}

void LoopTool::hover(const Eigen::Vector2d& pixel, const ToolScene& scene) {
  if (corners_.empty() || closed_) return;
  const auto pick = scene.pick(pixel);
  const Index vertex = pick ? pick->vertex : kNoIndex;
  if (vertex == hovered_ && !to_cursor_.empty()) return;
  hovered_ = vertex;
  to_cursor_.clear();
  if (vertex != kNoIndex) to_cursor_ = path(corners_.back(), vertex, scene);
}

bool LoopTool::is_first(const Eigen::Vector2d& pixel, const ToolScene& scene) const {
  if (corners_.size() < kFewestCorners) return false;
  const auto first = scene.projection.to_pixel(scene.positions[corners_.front()]);
  return first && (*first - pixel).norm() < scene.projection.in_pixels(kClosingPt);
}

// Returns the vertices of the polyline drawn so far, including the segment to the cursor. If the
// line is closed, its first vertex is repeated at the end.
std::vector<Index> LoopTool::line() const {
  std::vector<Index> line;
  const auto append = [&line](const std::vector<Index>& piece) {
    // A piece begins where the last one ended.
    const std::size_t repeated = line.empty() || piece.empty() ? 0 : 1;
    line.insert(line.end(), piece.begin() + static_cast<std::ptrdiff_t>(repeated), piece.end());
  };
  if (!corners_.empty()) line.push_back(corners_.front());
  for (const auto& piece : pieces_) append(piece);
  append(to_cursor_);
  return line;
}

}  // namespace lapwing::viewer
