#include <array>

#include <Eigen/Geometry>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/parallel.h"
#include "lapwing/remesh/fold_check.h"
#include "lapwing/remesh/passes.h"

namespace lapwing::remeshing {
namespace {

using Eigen::Vector3d;

// Returns the centroid of the triangles around `v`, weighted by area divided by the fourth power of
// the target length. This density leads to a centroidal Voronoi tessellation with cells of the
// target size.
Vector3d centroid(const WorkingPatch& patch, Index v) {
  Vector3d sum = Vector3d::Zero();
  double weights = 0.0;
  patch.net.for_outgoing(v, [&](Index h) {
    const auto [a, b, c] = patch.triangle(h);
    const double length =
        (patch.lengths[v] + patch.lengths[patch.net.target(h)] + patch.lengths[patch.net.apex(h)]) /
        (3.0 * patch.lengths[v]);
    const double weight = (b - a).cross(c - a).norm() / std::pow(length, 4);
    sum += weight * (a + b + c) / 3.0;
    weights += weight;
  });
  return weights > 0.0 ? Vector3d(sum / weights) : patch.at(v);
}

// Returns the point between the two neighbours of `v` on its line that divides their distance in
// the ratio of the wanted edge lengths.
Vector3d middle_on_line(const WorkingPatch& patch, Index v) {
  std::array<Index, 2> ends{v, v};
  std::size_t count = 0;
  patch.net.for_outgoing(v, [&](Index h) {
    if (patch.net.on_line(h) && count < 2) ends[count++] = patch.net.target(h);
  });
  const double first = patch.wanted_length(v, ends[0]);
  const double second = patch.wanted_length(v, ends[1]);
  return (second * patch.at(ends[0]) + first * patch.at(ends[1])) / (first + second);
}

Vector3d relaxed(WorkingPatch& patch, Index v, double step, const Vector3d& normal) {
  const Vector3d& p = patch.at(v);
  if (patch.kinds[v] == VertexKind::line) {
    return patch.project(v, p + step * (middle_on_line(patch, v) - p), normal);
  }
  const Vector3d move = centroid(patch, v) - p;
  return patch.project(v, p + step * (move - normal.dot(move) * normal), normal);
}

bool may_move(const WorkingPatch& patch, Index v, const Vector3d& place, const Vector3d& normal) {
  ReplacementCheck check(normal);
  patch.net.for_outgoing(v, [&](Index h) {
    const auto before = patch.triangle(h);
    check.add(before, {place, before[1], before[2]});
  });
  return check.passes() && !folds_when_moved(patch, place, v);
}

bool move_to(WorkingPatch& patch, Index v, const Vector3d& place, const Vector3d& normal) {
  if (!may_move(patch, v, place, normal)) return false;
  const double length = patch.target_length.at(place);
  if (patch.kinds[v] == VertexKind::line &&
      !patch.line_stays_near(patch.line_of(v), v, kNoIndex, place, length)) {
    return false;
  }
  patch.positions[v] = place;
  patch.lengths[v] = length;
  return true;
}

}  // namespace

void relax(WorkingPatch& patch) {
  const auto moves = [&](Index v) {
    return patch.net.has_vertex(v) && patch.kinds[v] != VertexKind::fixed;
  };
  Positions places = patch.positions;
  std::vector<Vector3d> normals(places.size());
  constexpr std::size_t kGrain = 256;
  parallel_for(places.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    CancelCheck cancel_check;
    for (auto v = static_cast<Index>(begin); v < end; ++v) {
      cancel_check();
      if (!moves(v)) continue;
      normals[v] = patch.normal_at(v);
      places[v] = relaxed(patch, v, 1.0, normals[v]);
    }
  });
  CancelCheck cancel_check;
  for (Index v = 0; v < places.size(); ++v) {
    cancel_check();
    if (!moves(v) || move_to(patch, v, places[v], normals[v])) continue;
    for (const double step : {0.5, 0.0}) {
      if (move_to(patch, v, relaxed(patch, v, step, normals[v]), normals[v])) break;
    }
  }
}

}  // namespace lapwing::remeshing
