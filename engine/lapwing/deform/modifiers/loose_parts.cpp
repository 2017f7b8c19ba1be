#include "lapwing/deform/modifiers/loose_parts.h"

#include <algorithm>
#include <limits>
#include <map>

#include <Eigen/LU>

#include "lapwing/laplacian/rotation.h"
#include "lapwing/mesh/closest_point.h"

namespace lapwing {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Total weight of a part's anchors; that of the contacts is 1. Contacts thus only determine the
// motion that anchors do not determine.
constexpr double kAnchorWeight = 1e4;
// Weight of the identity rotation, relative to the spread of the guides. It only matters if the
// guides are collinear.
constexpr double kStillness = 1e-9;

double size_of(const VertexSet& vertices, std::span<const Vector3d> positions) {
  Vector3d min = positions[vertices.front()];
  Vector3d max = min;
  for (const Index v : vertices) {
    min = min.cwiseMin(positions[v]);
    max = max.cwiseMax(positions[v]);
  }
  return (max - min).norm();
}

// Returns the weighted mean of `values` over the guides.
double mean_of(std::span<const double> values, const auto& guides, double otherwise) {
  if (values.empty()) return otherwise;
  double sum = 0.0;
  for (const auto& guide : guides) sum += guide.weight * values[guide.vertex];
  return sum;
}

// Returns the triangles of the mesh that belong to no loose part.
Adjacency triangles_of_rest(const EditRegion& region, const Topology& topology) {
  std::vector<char> is_loose(topology.vertex_count(), 0);
  for (const LoosePart& part : region.loose) {
    for (const Index v : part.vertices) is_loose[v] = 1;
  }
  for (const VertexSet& part : region.left_out) {
    for (const Index v : part) is_loose[v] = 1;
  }
  Adjacency group;
  for (std::size_t t = 0; t < topology.triangles.size(); ++t) {
    const Triangle& corners = topology.triangles[t];
    const auto loose = [&](Index v) { return is_loose[v] != 0; };
    if (std::none_of(corners.begin(), corners.end(), loose)) {
      group.values.push_back(static_cast<Index>(t));
    }
  }
  group.starts.push_back(static_cast<Index>(group.values.size()));
  return group;
}

// Returns the weight of each vertex of the surface for a part's motion.
std::map<Index, double> contacts(const VertexSet& part, std::span<const Vector3d> rest,
                                 const Topology& topology, const ClosestPoint& surface) {
  std::vector<TrianglePoint> nearest;
  std::vector<double> distances;
  Index hint = kNoIndex;
  for (const Index v : part) {
    nearest.push_back(surface.find(0, rest[v], Vector3d::Zero(), hint));
    distances.push_back((nearest.back().position - rest[v]).norm());
    hint = nearest.back().hint;
  }
  const double band = kContactBand * size_of(part, rest);
  const double least = *std::min_element(distances.begin(), distances.end());
  std::map<Index, double> weights;
  for (std::size_t k = 0; k < nearest.size(); ++k) {
    const double excess = distances[k] - least;
    if (excess > 0.0 && excess >= band) continue;
    const double closeness = excess > 0.0 ? 1.0 - excess / band : 1.0;
    const Triangle& corners = topology.triangles[nearest[k].triangle];
    for (std::size_t c = 0; c < 3; ++c) {
      weights[corners[c]] += closeness * closeness * nearest[k].weights[c];
    }
  }
  return weights;
}

}  // namespace

LooseParts::LooseParts(const EditRegion& region, std::span<const Vector3d> rest,
                       const Topology& topology)
    : rest_(rest) {
  if (region.loose.empty()) return;
  const ClosestPoint surface(topology.triangles, rest, triangles_of_rest(region, topology));
  for (const LoosePart& loose : region.loose) {
    Part& part = parts_.emplace_back();
    part.vertices = &loose.vertices;
    const std::map<Index, double> weights = contacts(loose.vertices, rest, topology, surface);
    double sum = 0.0;
    for (const auto& [vertex, weight] : weights) sum += weight;
    for (const auto& [vertex, weight] : weights) {
      part.guides.push_back({vertex, false, weight / sum});
    }
    for (const LooseAnchor& anchor : loose.anchors) {
      const auto count = static_cast<double>(loose.anchors.size());
      part.guides.push_back({anchor.vertex, true, kAnchorWeight / count});
    }
    const double all = loose.anchors.empty() ? 1.0 : 1.0 + kAnchorWeight;
    for (Guide& guide : part.guides) {
      guide.weight /= all;
      part.center += guide.weight * rest[guide.vertex];
    }
  }
}

LooseParts::Lead LooseParts::lead(const Part& part, std::span<const Vector3d> prescribed,
                                  std::span<const Vector3d> u) {
  Lead lead;
  for (const Guide& guide : part.guides) {
    lead.displacements.push_back(guide.is_anchor ? prescribed[guide.vertex] : u[guide.vertex]);
    lead.mean += guide.weight * lead.displacements.back();
  }
  return lead;
}

void LooseParts::carry(std::span<const Vector3d> prescribed, std::span<const double> scales,
                       std::span<Vector3d> u) const {
  for (const Part& part : parts_) {
    const auto [displacements, mean] = lead(part, prescribed, u);
    const double scale = mean_of(scales, part.guides, 1.0);
    Matrix3d H = Matrix3d::Zero();
    double spread = 0.0;
    for (std::size_t g = 0; g < part.guides.size(); ++g) {
      const Vector3d arm = rest_[part.guides[g].vertex] - part.center;
      H += part.guides[g].weight * (arm + displacements[g] - mean) * arm.transpose();
      spread += part.guides[g].weight * arm.squaredNorm();
    }
    const bool still = std::all_of(displacements.begin(), displacements.end(),
                                   [](const Vector3d& d) { return d.isZero(0.0); });
    Matrix3d turn = Matrix3d::Zero();  // scaled rotation minus the identity
    if (!still || scale != 1.0) {
      H += kStillness * spread * Matrix3d::Identity();
      turn = scale * nearest_rotation(H) - Matrix3d::Identity();
    }
    for (const Index v : *part.vertices) u[v] = mean + turn * (rest_[v] - part.center);
  }
}

void LooseParts::carry_linear(std::span<const Vector3d> prescribed, std::span<const double> growth,
                              std::span<Vector3d> u) const {
  for (const Part& part : parts_) {
    const auto [displacements, mean] = lead(part, prescribed, u);
    Matrix3d inertia = std::numeric_limits<double>::min() * Matrix3d::Identity();
    Vector3d moment = Vector3d::Zero();
    for (std::size_t g = 0; g < part.guides.size(); ++g) {
      const double weight = part.guides[g].weight;
      const Vector3d arm = rest_[part.guides[g].vertex] - part.center;
      inertia += weight * ((1.0 + kStillness) * arm.squaredNorm() * Matrix3d::Identity() -
                           arm * arm.transpose());
      moment += weight * arm.cross(displacements[g]);
    }
    const Vector3d turn = inertia.inverse() * moment;
    const double more = mean_of(growth, part.guides, 0.0);
    for (const Index v : *part.vertices) {
      const Vector3d arm = rest_[v] - part.center;
      u[v] = mean + turn.cross(arm) + more * arm;
    }
  }
}

void LooseParts::carry_straight(std::span<const Vector3d> prescribed, std::span<Vector3d> u) const {
  for (const Part& part : parts_) {
    const Vector3d mean = lead(part, prescribed, u).mean;
    for (const Index v : *part.vertices) u[v] = mean;
  }
}

}  // namespace lapwing
