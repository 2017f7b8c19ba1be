#include "lapwing/deform/certificate_warnings.h"

#include <cmath>
#include <sstream>

#include "lapwing/base/counted.h"

namespace lapwing {
namespace {

// Returns advice against folds.
std::string advice(const Certificate& c) {
  const std::string move = "Move the handle less, rotate it with its motion, or use several steps";
  return c.region_is_whole ? move + "." : move + ", or enlarge the region.";
}

std::ostringstream short_numbers() {
  std::ostringstream text;
  text.precision(4);
  return text;
}

}  // namespace

bool misses_handles(const Certificate& c) {
  return c.rest_diagonal > 0.0 &&
         (c.handle_error > 0.01 * c.rest_diagonal || c.handle_error > 0.25 * c.prescribed_motion);
}

std::vector<std::string> warnings_of(const Certificate& c) {
  std::vector<std::string> warnings;
  if (!c.settled) {
    std::ostringstream text = short_numbers();
    text
        << "not settled after "
        << counted(static_cast<std::size_t>(c.settle_iterations), "iterations")
        << ": one more would move a vertex by " << c.settle_last_step << " mean edge lengths. "
        << (c.lacks_hessian
                ? "The Hessian does not fit into the available memory. Choose a smaller region, or "
                  "free memory."
                : "Raise \"max_iterations\" of \"settle\", or move in smaller steps.");
    warnings.push_back(text.str());
  }
  if (misses_handles(c)) {
    std::ostringstream text = short_numbers();
    text << "a handle misses its place by " << c.handle_error << " ("
         << 100.0 * c.handle_error / c.rest_diagonal << "% of the mesh's diagonal) on a path of "
         << c.prescribed_motion
         << ": raise or remove \"constraint_weight\" or the handle's \"weight\", or set \"hard\"";
    warnings.push_back(text.str());
  }
  if (c.inside_out_share > kMostInsideOut) {
    std::ostringstream text = short_numbers();
    text << std::lround(100.0 * c.inside_out_share)
         << "% of the region is inside out, around vertex " << c.inside_out_vertex << ". "
         << advice(c);
    warnings.push_back(text.str());
  } else if (c.flipped_triangles > 0) {
    std::ostringstream text = short_numbers();
    text << c.flipped_triangles
         << (c.flipped_triangles == 1 ? " triangle is flipped, "
                                      : " triangles are flipped, the first ")
         << c.first_flipped_triangles.front() << ". " << advice(c);
    warnings.push_back(text.str());
  }
  const double ratio = c.largest_edge_stretch + 1.0;
  if (ratio > kLongEdge) {
    std::ostringstream text = short_numbers();
    text << "the edge from vertex " << c.largest_edge_stretch_vertices[0] << " to "
         << c.largest_edge_stretch_vertices[1] << " is now " << ratio
         << " times as long. Move the handle less"
         << (c.region_is_whole ? "." : ", or enlarge the region.");
    warnings.push_back(text.str());
  }
  return warnings;
}

}  // namespace lapwing
