#include "lapwing/deform/mirror.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lapwing/base/errors.h"
#include "lapwing/base/parallel.h"
#include "lapwing/closest/closest_point.h"
#include "lapwing/laplacian/decompositions.h"
#include "lapwing/mesh/topology.h"

namespace lapwing {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr std::size_t kMostSamples = 2000;
constexpr int kMostRounds = 60;

ClosestPoint surface_of(const Mesh& mesh, const std::string& where) {
  const std::vector<Triangle>& triangles = mesh.topology().triangles;
  Adjacency group;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const bool finite = std::all_of(triangles[t].begin(), triangles[t].end(),
                                    [&](Index v) { return mesh.positions[v].allFinite(); });
    if (finite) group.values.push_back(static_cast<Index>(t));
  }
  if (group.values.empty()) {
    throw InputError(where + ": the mesh has no triangle, and so no surface to mirror");
  }
  group.starts.push_back(static_cast<Index>(group.values.size()));
  return {triangles, mesh.positions, group};
}

// Vertices with a triangle, evenly by number.
std::vector<Vector3d> samples_of(const Mesh& mesh) {
  std::vector<Vector3d> all;
  const Adjacency& rings = mesh.topology().rings;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (rings.size(v) > 0 && mesh.positions[v].allFinite()) all.push_back(mesh.positions[v]);
  }
  if (all.size() <= kMostSamples) return all;
  std::vector<Vector3d> samples;
  for (std::size_t k = 0; k < kMostSamples; ++k) {
    samples.push_back(all[k * all.size() / kMostSamples]);
  }
  return samples;
}

Vector3d mean_of(std::span<const Vector3d> points) {
  Vector3d sum = Vector3d::Zero();
  for (const Vector3d& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

// The points of the surface that are nearest to the images of the samples, and the mean square
// distance.
std::vector<Vector3d> nearest_to_images(const ClosestPoint& surface,
                                        std::span<const Vector3d> samples,
                                        const MirrorPlane& plane, double& mean_square) {
  const Eigen::Affine3d mirror = reflection(plane);
  std::vector<Vector3d> nearest(samples.size());
  parallel_for(samples.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      nearest[k] = surface.find(0, mirror * samples[k]).position;
    }
  });
  mean_square = 0.0;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    mean_square += (nearest[k] - mirror * samples[k]).squaredNorm();
  }
  mean_square /= static_cast<double>(samples.size());
  return nearest;
}

// The plane that carries each p nearest to its q: through the middle of all, across the direction
// n that makes sum (n.p) (n.q) least.
MirrorPlane best_plane(std::span<const Vector3d> p, std::span<const Vector3d> q) {
  const Vector3d center = 0.5 * (mean_of(p) + mean_of(q));
  Matrix3d B = Matrix3d::Zero();
  for (std::size_t k = 0; k < p.size(); ++k) {
    const Matrix3d product = (p[k] - center) * (q[k] - center).transpose();
    B += product + product.transpose();
  }
  return {center, symmetric_eigenvectors(B).vectors.col(0)};
}

FoundMirror refined(const ClosestPoint& surface, std::span<const Vector3d> samples,
                    MirrorPlane plane) {
  FoundMirror best{plane, std::numeric_limits<double>::infinity()};
  for (int round = 0; round < kMostRounds; ++round) {
    double mean_square = 0.0;
    const std::vector<Vector3d> nearest = nearest_to_images(surface, samples, plane, mean_square);
    if (!(mean_square < 0.999999 * best.asymmetry)) break;
    best = {plane, mean_square};
    plane = best_plane(samples, nearest);
  }
  return best;
}

}  // namespace

Eigen::Affine3d reflection(const MirrorPlane& plane) {
  const Vector3d n = plane.normal.normalized();
  Eigen::Affine3d mirror = Eigen::Affine3d::Identity();
  mirror.linear() -= 2.0 * n * n.transpose();
  mirror.translation() = 2.0 * n.dot(plane.point) * n;
  return mirror;
}

FoundMirror find_mirror_plane(const Mesh& mesh, const std::string& where) {
  const ClosestPoint surface = surface_of(mesh, where);
  const std::vector<Vector3d> samples = samples_of(mesh);
  const double diagonal = bounds_of(samples).diagonal();
  if (!(diagonal > 0.0)) throw InputError(where + ": the mesh has no extent to be mirrored");
  const Vector3d center = mean_of(samples);
  Matrix3d spread = Matrix3d::Zero();
  for (const Vector3d& p : samples) spread += (p - center) * (p - center).transpose();
  const Matrix3d principal = symmetric_eigenvectors(spread).vectors;
  FoundMirror best{{}, std::numeric_limits<double>::infinity()};
  for (Eigen::Index k = 0; k < 6; ++k) {
    const Vector3d normal = k < 3 ? Vector3d(Vector3d::Unit(k))
                                  : Vector3d(principal.col(k - 3));
    const FoundMirror found = refined(surface, samples, {center, normal});
    // Of two as good, the first: shapes with many planes take a coordinate one.
    if (found.asymmetry < 0.99 * best.asymmetry - 1e-24 * diagonal * diagonal) best = found;
  }
  best.asymmetry = std::sqrt(best.asymmetry) / diagonal;
  return best;
}

double asymmetry_of(const Mesh& mesh, const MirrorPlane& plane, const std::string& where) {
  const std::vector<Vector3d> samples = samples_of(mesh);
  double mean_square = 0.0;
  nearest_to_images(surface_of(mesh, where), samples, plane, mean_square);
  return std::sqrt(mean_square) / bounds_of(samples).diagonal();
}

std::vector<Index> mirror_images(const Mesh& mesh, const MirrorPlane& plane,
                                 const std::string& where) {
  const Vector3d n = plane.normal.normalized();
  const Bounds bounds = bounds_of(mesh.positions);
  const double half = 0.5 * (bounds.max - bounds.min).dot(n.cwiseAbs());
  const double off = std::abs(n.dot(bounds.center() - plane.point));
  if (!(off <= half)) {
    throw InputError(where + ": the mirror plane does not pass through the mesh; give a point of "
                             "the plane, or \"auto\"");
  }
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
