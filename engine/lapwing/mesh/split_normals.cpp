#include "lapwing/mesh/split_normals.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/union_find.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

// Tolerance in radians. If the sides of a regular prism meet at exactly the feature angle, the
// tolerance makes all edges between them smooth, in spite of rounding errors.
constexpr double kAngleRounding = 1e-6;

// A spoke is a side of a triangle around a vertex that connects this vertex to a neighbour. An
// interior edge has two spokes, one for each of its triangles.
struct Spoke {
  Index neighbour;
  Index place;  // index of the triangle in the list around the vertex
  bool leaves;  // whether the side points from the vertex to the neighbour
};

class NormalSplitter {
 public:
  NormalSplitter(std::span<const Vector3d> positions, const Topology& topology, double degrees)
      : topology_(topology), normals_(unit_normals(positions, topology)) {
    const double angle = degrees * std::numbers::pi / 180.0;
    least_cosine_ = std::cos(std::min(angle + kAngleRounding, std::numbers::pi));
    cosine_of_half_ = std::cos(0.5 * angle);
    for (const Triangle& t : topology.triangles) {
      split_.of_corner.insert(split_.of_corner.end(), t.begin(), t.end());
    }
  }

  SplitNormals run() {
    CancelCheck cancel_check;
    for (Index v = 0; v < topology_.vertex_count(); ++v) {
      cancel_check();
      if (!is_surely_smooth(v)) split(v);
    }
    return std::move(split_);
  }

 private:
  // Returns the unit normal of each polygon, or zero if the area of the polygon is zero.
  static std::vector<Vector3d> unit_normals(std::span<const Vector3d> positions,
                                            const Topology& topology) {
    std::vector<Vector3d> normals;
    for (std::size_t t = 0; t < topology.triangles.size(); ++t) {
      const auto& [a, b, c] = topology.triangles[t];
      if (normals.size() <= topology.triangle_faces[t]) {
        normals.resize(topology.triangle_faces[t] + 1, Vector3d::Zero());
      }
      normals[topology.triangle_faces[t]] +=
          (positions[b] - positions[a]).cross(positions[c] - positions[a]);
    }
    for (Vector3d& normal : normals) {
      const double area = normal.stableNorm();
      normal = area > 0.0 && std::isfinite(area) ? Vector3d(normal / area) : Vector3d::Zero();
    }
    return normals;
  }

  const Vector3d& normal_of(Index triangle) const {
    return normals_[topology_.triangle_faces[triangle]];
  }

  // If this returns true, the normals of any two polygons around the vertex differ by at most the
  // feature angle. Tests a sufficient condition: each differs from the first by at most half the
  // angle.
  bool is_surely_smooth(Index v) const {
    const auto around = topology_.vertex_triangles[v];
    return std::ranges::all_of(around, [&](Index t) {
      return normal_of(t).dot(normal_of(around.front())) >= cosine_of_half_;
    });
  }

  bool is_smooth(Index t, Index u) const {
    return topology_.triangle_faces[t] == topology_.triangle_faces[u] ||
           normal_of(t).dot(normal_of(u)) >= least_cosine_;
  }

  // Lists the spokes of the vertex. Spokes to the same neighbour are adjacent in the list.
  void list_spokes(Index v) {
    spokes_.clear();
    const auto around = topology_.vertex_triangles[v];
    for (Index place = 0; place < around.size(); ++place) {
      const Triangle& t = topology_.triangles[around[place]];
      const auto k = static_cast<std::size_t>(std::ranges::find(t, v) - t.begin());
      spokes_.push_back({t[(k + 1) % 3], place, true});
      spokes_.push_back({t[(k + 2) % 3], place, false});
    }
    std::ranges::stable_sort(spokes_, {}, &Spoke::neighbour);
  }

  void split(Index v) {
    list_spokes(v);
    const auto around = topology_.vertex_triangles[v];
    UnionFind fans(around.size());
    for (auto first = spokes_.begin(); first != spokes_.end();) {
      const auto end = std::find_if(
          first, spokes_.end(), [&](const Spoke& s) { return s.neighbour != first->neighbour; });
      const bool is_manifold = end - first == 2 && first[0].leaves != first[1].leaves;
      if (is_manifold && is_smooth(around[first[0].place], around[first[1].place])) {
        fans.unite(first[0].place, first[1].place);
      }
      first = end;
    }
    number(v, fans);
  }

  // Assigns a normal to each fan with nonzero area. The first such fan gets the first normal of the
  // vertex. Each other fan gets an extra normal.
  void number(Index v, UnionFind& fans) {
    const auto around = topology_.vertex_triangles[v];
    numbers_.assign(around.size(), kNoIndex);
    bool is_first = true;
    for (Index place = 0; place < around.size(); ++place) {
      if (normal_of(around[place]).isZero(0.0)) continue;
      Index& normal = numbers_[fans.find(place)];
      if (normal == kNoIndex) {
        normal = is_first ? v : further_normal(v);
        is_first = false;
      }
      const Triangle& t = topology_.triangles[around[place]];
      const auto k = static_cast<std::size_t>(std::ranges::find(t, v) - t.begin());
      split_.of_corner[3 * std::size_t{around[place]} + k] = normal;
    }
  }

  Index further_normal(Index v) {
    split_.extra_vertices.push_back(v);
    return static_cast<Index>(topology_.vertex_count() + split_.extra_vertices.size() - 1);
  }

  const Topology& topology_;
  std::vector<Vector3d> normals_;  // per polygon
  double least_cosine_ = 0.0;
  double cosine_of_half_ = 0.0;
  SplitNormals split_;
  std::vector<Spoke> spokes_;
  std::vector<Index> numbers_;  // index of the normal of each fan around a vertex
};

}  // namespace

SplitNormals split_normals(std::span<const Vector3d> positions, const Topology& topology,
                           double feature_angle_degrees) {
  // Two normals differ by at most 180 degrees, so this angle makes all edges smooth.
  if (feature_angle_degrees >= 180.0) {
    SplitNormals one;
    for (const Triangle& t : topology.triangles) {
      one.of_corner.insert(one.of_corner.end(), t.begin(), t.end());
    }
    return one;
  }
  return NormalSplitter(positions, topology, feature_angle_degrees).run();
}

}  // namespace lapwing
