#include "lapwing/remesh/working_patch.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include <Eigen/Geometry>

#include "lapwing/base/errors.h"

namespace lapwing::remeshing {
namespace {

using Eigen::Vector3d;
using Corners = std::array<Vector3d, 3>;

// Triangles of this quality, whose angles are at least about 15 degrees, are good enough.
constexpr double kGoodEnough = 0.4;
// Below this quality, the normal of a triangle consists of rounding errors.
constexpr double kNoQuality = 1e-9;
// Largest distance of a line from its original, in target lengths.
constexpr double kLineTolerance = 0.1;
constexpr int kLineSamples = 8;
constexpr double kLargestTurnCosine = 0.5;

Vector3d area_vector(const Corners& t) {
  return (t[1] - t[0]).cross(t[2] - t[0]);
}

std::vector<Triangle> segments_of(const OriginalPatch& original) {
  std::vector<Triangle> segments;
  for (const Index h : original.lines.values) {
    const Index end = original.net.target(h);
    segments.push_back({original.net.origin(h), end, end});
  }
  return segments;
}

// Returns consecutive numbers in rows of the same lengths as `lists`.
Adjacency numbered(const Adjacency& lists) {
  Adjacency rows = lists;
  for (Index i = 0; i < rows.values.size(); ++i) rows.values[i] = i;
  return rows;
}

}  // namespace

double TargetSizingField::at(const Eigen::Vector3d& point) const {
  const double length = length_(point);
  if (length > 0.0 && std::isfinite(length)) return length;
  std::ostringstream message;
  message << "the target edge length at (" << point.transpose() << ") is " << length
          << "; it must be positive";
  throw InputError(message.str());
}

Reference::Reference(const OriginalPatch& original)
    : original_(original),
      sheets_(original.triangles, original.positions, original.sheets),
      lines_(segments_of(original), original.positions, numbered(original.lines)) {}

LinePoint Reference::on_line(Index line, const Vector3d& point, Index hint) const {
  const TrianglePoint found = lines_.find(line, point, Vector3d::Zero(), hint);
  return {original_.lines.values[found.triangle], found.weights[1] + found.weights[2],
          found.position, found.hint};
}

WorkingPatch::WorkingPatch(const OriginalPatch& original_patch, const TargetSizingField& target,
                           std::vector<double> lengths_at_vertices)
    : original(original_patch),
      target_length(target),
      reference(original_patch),
      net(original_patch.net),
      positions(original_patch.positions),
      lengths(std::move(lengths_at_vertices)),
      kinds(original_patch.kinds),
      hints(original_patch.kinds.size(), kNoIndex),
      sheet_of(original_patch.sheet_of) {}

Index WorkingPatch::line_of(Index v) const {
  Index line = kNoIndex;
  net.for_outgoing(v, [&](Index h) {
    if (net.on_line(h)) line = net.side(h) / 2;
  });
  return line;
}

Vector3d WorkingPatch::normal_at(Index v) const {
  Vector3d sum = Vector3d::Zero();
  net.for_outgoing(v, [&](Index h) { sum += area_vector(triangle(h)); });
  const double length = sum.norm();
  return length > 0.0 ? Vector3d(sum / length) : Vector3d::Zero();
}

Vector3d WorkingPatch::project(Index v, const Vector3d& point, const Vector3d& normal) {
  if (kinds[v] == VertexKind::line) {
    const LinePoint found = reference.on_line(line_of(v), point, hints[v]);
    hints[v] = found.hint;
    return found.position;
  }
  const Index sheet = sheet_of[net.outgoing(v) / 3];
  const TrianglePoint found = reference.on_sheet(sheet, point, normal, hints[v]);
  hints[v] = found.hint;
  return found.position;
}

bool WorkingPatch::line_stays_near(Index line, Index v, Index except, const Vector3d& place,
                                   double length) const {
  bool near = true;
  net.for_outgoing(v, [&](Index h) {
    const Index end = net.target(h);
    if (!net.on_line(h) || net.side(h) / 2 != line || end == except) return;
    for (int i = 1; i < kLineSamples; ++i) {
      const Vector3d point = place + (static_cast<double>(i) / kLineSamples) * (at(end) - place);
      const double away = (reference.on_line(line, point).position - point).norm();
      near = near && away <= kLineTolerance * length;
    }
  });
  return near;
}

bool WorkingPatch::is_same(Index a, Index b) const {
  return a == b || (mesh_vertex(a) != kNoIndex && mesh_vertex(a) == mesh_vertex(b));
}

bool WorkingPatch::are_joined(Index a, Index b) const {
  const std::array ends{std::min(mesh_vertex(a), mesh_vertex(b)),
                        std::max(mesh_vertex(a), mesh_vertex(b))};
  if (std::ranges::binary_search(original.outside_edges, ends)) return true;
  bool joined = false;
  Index copy = a;
  do {
    net.for_neighbours(copy, [&](Index w) { joined = joined || is_same(w, b); });
    copy = next_copy(copy);
  } while (copy != a);
  return joined;
}

double triangle_quality(const Corners& t) {
  const double sides =
      (t[1] - t[0]).squaredNorm() + (t[2] - t[1]).squaredNorm() + (t[0] - t[2]).squaredNorm();
  return sides > 0.0 ? 2.0 * std::sqrt(3.0) * area_vector(t).norm() / sides : 0.0;
}

void ReplacementCheck::add(const Corners& before, const Corners& after) {
  const double quality_before = triangle_quality(before);
  const double quality_after = triangle_quality(after);
  worst_before_ = std::min(worst_before_, quality_before);
  worst_after_ = std::min(worst_after_, quality_after);
  const Vector3d was = quality_before > kNoQuality ? area_vector(before) : fallback_;
  const Vector3d is = area_vector(after);
  if (quality_after > kNoQuality && is.dot(was) < kLargestTurnCosine * is.norm() * was.norm()) {
    turned_ = true;
  }
}

bool ReplacementCheck::passes() const {
  return !turned_ && worst_after_ >= std::min(kGoodEnough, worst_before_ - kSameQuality) &&
         (worst_after_ > kNoQuality || worst_before_ <= kNoQuality);
}

}  // namespace lapwing::remeshing
