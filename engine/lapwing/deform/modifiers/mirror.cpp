#include "lapwing/deform/modifiers/mirror.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lapwing/base/errors.h"
#include "lapwing/base/parallel.h"
#include "lapwing/laplacian/decompositions.h"
#include "lapwing/mesh/closest_point.h"
#include "lapwing/mesh/topology.h"

namespace lapwing {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// A search uses at most `samples` vertices and `rounds` steps.
struct Effort {
  std::size_t samples;
  int rounds;
};
// kCoarse applies to all starting planes, kFine to the kBest best planes.
constexpr Effort kCoarse{300, 12};
constexpr Effort kFine{2000, 60};
constexpr std::size_t kBest = 3;

ClosestPoint surface_of(const Mesh& mesh, const std::string& where) {
  const std::vector<Triangle>& triangles = mesh.topology().triangles;
  Adjacency group;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const bool finite = std::all_of(triangles[t].begin(), triangles[t].end(),
                                    [&](Index v) { return mesh.positions[v].allFinite(); });
    if (finite) group.values.push_back(static_cast<Index>(t));
  }
  if (group.values.empty()) {
    throw InputError(where + ": the mesh has no triangles, so there is no surface to mirror");
  }
  group.starts.push_back(static_cast<Index>(group.values.size()));
  return {triangles, mesh.positions, group};
}

// Eigen's `normalized` fails for lengths such as 1e-200 or 1e200.
Vector3d unit_normal(const MirrorPlane& plane) {
  return plane.normal.stableNormalized();
}

// Returns the positions of at most `most` vertices that are in a triangle, evenly spaced by vertex
// index.
std::vector<Vector3d> samples_of(const Mesh& mesh, std::size_t most) {
  std::vector<Vector3d> all;
  const Adjacency& rings = mesh.topology().rings;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (rings.size(v) > 0 && mesh.positions[v].allFinite()) all.push_back(mesh.positions[v]);
  }
  if (all.size() <= most) return all;
  std::vector<Vector3d> samples;
  for (std::size_t k = 0; k < most; ++k) samples.push_back(all[k * all.size() / most]);
  return samples;
}

Vector3d mean_of(std::span<const Vector3d> points) {
  Vector3d sum = Vector3d::Zero();
  for (const Vector3d& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

// For the mirror image of each sample, returns the closest point of the surface. Sets the mean
// squared distance. `hints`, one per sample, come from the last search.
std::vector<Vector3d> nearest_to_images(const ClosestPoint& surface,
                                        std::span<const Vector3d> samples, const MirrorPlane& plane,
                                        std::span<Index> hints, double& mean_square) {
  const Eigen::Affine3d mirror = reflection(plane);
  std::vector<Vector3d> nearest(samples.size());
  parallel_for(samples.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const TrianglePoint found = surface.find(0, mirror * samples[k], Vector3d::Zero(), hints[k]);
      nearest[k] = found.position;
      hints[k] = found.hint;
    }
  });
  mean_square = 0.0;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    mean_square += (nearest[k] - mirror * samples[k]).squaredNorm();
  }
  mean_square /= static_cast<double>(samples.size());
  return nearest;
}

// Returns the plane for which the mirror images of the points p are closest to the points q. It
// passes through the mean of all points, and its normal n minimizes sum (n.p) (n.q), with p and q
// relative to that mean.
MirrorPlane best_plane(std::span<const Vector3d> p, std::span<const Vector3d> q) {
  const Vector3d center = 0.5 * (mean_of(p) + mean_of(q));
  Matrix3d B = Matrix3d::Zero();
  for (std::size_t k = 0; k < p.size(); ++k) {
    const Matrix3d product = (p[k] - center) * (q[k] - center).transpose();
    B += product + product.transpose();
  }
  return {center, symmetric_eigenvectors(B).vectors.col(0)};
}

// Returns the normals of the starting planes: the directions to faces, edges and corners of a cube
// along the coordinate axes, and of one along the principal axes.
std::vector<Vector3d> first_normals(std::span<const Vector3d> samples, const Vector3d& center) {
  constexpr int kCube[13][3] = {{1, 0, 0},  {0, 1, 0},  {0, 0, 1},  {1, 1, 0},  {1, -1, 0},
                                {1, 0, 1},  {1, 0, -1}, {0, 1, 1},  {0, 1, -1}, {1, 1, 1},
                                {1, 1, -1}, {1, -1, 1}, {1, -1, -1}};
  Matrix3d spread = Matrix3d::Zero();
  for (const Vector3d& p : samples) spread += (p - center) * (p - center).transpose();
  const Matrix3d principal = symmetric_eigenvectors(spread).vectors;
  std::vector<Vector3d> normals;
  for (const auto& [x, y, z] : kCube) normals.push_back(Vector3d(x, y, z).normalized());
  for (const auto& [x, y, z] : kCube) {
    normals.push_back(principal * Vector3d(x, y, z).normalized());
  }
  return normals;
}

FoundMirror refined(const ClosestPoint& surface, std::span<const Vector3d> samples,
                    MirrorPlane plane, int most_rounds) {
  FoundMirror best{plane, std::numeric_limits<double>::infinity()};
  std::vector<Index> hints(samples.size(), kNoIndex);
  for (int round = 0; round < most_rounds; ++round) {
    double mean_square = 0.0;
    const std::vector<Vector3d> nearest =
        nearest_to_images(surface, samples, plane, hints, mean_square);
    if (!(mean_square < 0.999999 * best.asymmetry)) break;
    best = {plane, mean_square};
    plane = best_plane(samples, nearest);
  }
  return best;
}

}  // namespace

void require_plane(const MirrorPlane& plane, const std::string& where) {
  if (!plane.point.allFinite()) {
    throw InputError(where +
                     ": the point of the mirror plane is not finite; give finite coordinates");
  }
  if (!plane.normal.allFinite()) {
    throw InputError(where +
                     ": the normal of the mirror plane is not finite; give finite coordinates");
  }
  if (plane.normal.isZero(0.0)) {
    throw InputError(where + ": the normal of the mirror plane is zero; give a direction");
  }
}

void require_through(const MirrorPlane& plane, const Mesh& mesh, const std::string& where) {
  require_plane(plane, where);
  const Vector3d n = unit_normal(plane);
  const Bounds bounds = bounds_of(mesh.positions);
  const double half = 0.5 * (bounds.max - bounds.min).dot(n.cwiseAbs());
  const double off = std::abs(n.dot(bounds.center() - plane.point));
  if (off <= half) return;
  throw InputError(where +
                   ": the mirror plane does not pass through the mesh; give a point of the plane, "
                   "or \"auto\"");
}

Eigen::Affine3d reflection(const MirrorPlane& plane) {
  const Vector3d n = unit_normal(plane);
  Eigen::Affine3d mirror = Eigen::Affine3d::Identity();
  mirror.linear() -= 2.0 * n * n.transpose();
  mirror.translation() = 2.0 * n.dot(plane.point) * n;
  return mirror;
}

FoundMirror find_mirror_plane(const Mesh& mesh, const std::string& where) {
  const ClosestPoint surface = surface_of(mesh, where);
  const std::vector<Vector3d> samples = samples_of(mesh, kFine.samples);
  const double diagonal = bounds_of(samples).diagonal();
  if (!(diagonal > 0.0)) {
    throw InputError(where + ": all vertices of the mesh coincide, so it cannot be mirrored");
  }
  const std::vector<Vector3d> few = samples_of(mesh, kCoarse.samples);
  const Vector3d center = mean_of(samples);
  std::vector<FoundMirror> found;
  for (const Vector3d& normal : first_normals(samples, center)) {
    found.push_back(refined(surface, few, {center, normal}, kCoarse.rounds));
  }
  // Among equally good planes, the first one is selected. A shape with many planes of symmetry thus
  // gets a coordinate plane.
  const double rounding = 1e-20 * diagonal * diagonal;
  std::stable_sort(found.begin(), found.end(), [&](const FoundMirror& a, const FoundMirror& b) {
    return std::max(a.asymmetry, rounding) < std::max(b.asymmetry, rounding);
  });
  FoundMirror best{{}, std::numeric_limits<double>::infinity()};
  for (std::size_t k = 0; k < std::min(kBest, found.size()); ++k) {
    const FoundMirror fine = refined(surface, samples, found[k].plane, kFine.rounds);
    if (fine.asymmetry < 0.99 * best.asymmetry - rounding) best = fine;
  }
  best.asymmetry = std::sqrt(best.asymmetry) / diagonal;
  return best;
}

double asymmetry_of(const Mesh& mesh, const MirrorPlane& plane, const std::string& where) {
  const std::vector<Vector3d> samples = samples_of(mesh, kFine.samples);
  double mean_square = 0.0;
  std::vector<Index> hints(samples.size(), kNoIndex);
  nearest_to_images(surface_of(mesh, where), samples, plane, hints, mean_square);
  return std::sqrt(mean_square) / bounds_of(samples).diagonal();
}

std::vector<Index> mirror_images(const Mesh& mesh, const MirrorPlane& plane,
                                 const std::string& where) {
  require_through(plane, mesh, where);
  const ClosestPoint surface = surface_of(mesh, where);
  const Eigen::Affine3d mirror = reflection(plane);
  const Topology& topology = mesh.topology();
  std::vector<Index> images(mesh.vertex_count());
  parallel_for(images.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      images[v] = static_cast<Index>(v);
      if (topology.rings.size(v) == 0 || !mesh.positions[v].allFinite()) continue;
      const TrianglePoint nearest = surface.find(0, mirror * mesh.positions[v]);
      const auto largest = std::max_element(nearest.weights.begin(), nearest.weights.end());
      const auto corner = static_cast<std::size_t>(largest - nearest.weights.begin());
      images[v] = topology.triangles[nearest.triangle][corner];
    }
  });
  return images;
}

VertexSet mirrored(const VertexSet& set, std::span<const Index> images) {
  const std::vector<char> in_set = vertex_mask(images.size(), set);
  VertexSet result;
  for (std::size_t v = 0; v < images.size(); ++v) {
    if (in_set[images[v]]) result.push_back(static_cast<Index>(v));
  }
  return result;
}

}  // namespace lapwing
