#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

#include "lapwing/base/numbers.h"
#include "lapwing/mesh/closest_point.h"
#include "lapwing/remesh/original_patch.h"

namespace lapwing::remeshing {

/// The sizing field, the target edge length at each point. `at` throws InputError, naming the
/// point, if the length is not positive or not finite.
class TargetSizingField {
 public:
  explicit TargetSizingField(const std::function<double(const Eigen::Vector3d&)>& length)
      : length_(length) {}
  double at(const Eigen::Vector3d& point) const;

 private:
  const std::function<double(const Eigen::Vector3d&)>& length_;
};

/// A point on a line of the original patch, at the fraction `along` of the length of `halfedge`.
struct LinePoint {
  Index halfedge = kNoIndex;
  double along = 0.0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Index hint = kNoIndex;  ///< speeds up the next search on the same line
};

/// The original surface and lines, onto which vertices are projected.
class Reference {
 public:
  explicit Reference(const OriginalPatch& original);

  /// See ClosestPoint::find.
  TrianglePoint on_sheet(Index sheet, const Eigen::Vector3d& point,
                         const Eigen::Vector3d& direction, Index hint = kNoIndex) const {
    return sheets_.find(sheet, point, direction, hint);
  }
  LinePoint on_line(Index line, const Eigen::Vector3d& point, Index hint = kNoIndex) const;

 private:
  const OriginalPatch& original_;
  ClosestPoint sheets_;
  ClosestPoint lines_;
};

/// Cosines, angles and qualities that differ by less are treated as equal. Such differences are
/// rounding errors, for example if a vertex moves within the plane of its triangles.
inline constexpr double kSameQuality = 1e-9;

/// The patch during remeshing. Original vertices have the indices of OriginalPatch; new vertices
/// follow.
struct WorkingPatch {
  WorkingPatch(const OriginalPatch& original_patch, const TargetSizingField& target,
               std::vector<double> lengths_at_vertices);

  const OriginalPatch& original;
  const TargetSizingField& target_length;
  Reference reference;
  Halfedges net;
  Positions positions;
  std::vector<double> lengths;  ///< per vertex: target length
  std::vector<VertexKind> kinds;
  std::vector<Index> hints;     ///< per vertex: TrianglePoint::hint for `project`
  std::vector<Index> sheet_of;  ///< per triangle

  const Eigen::Vector3d& at(Index v) const { return positions[v]; }
  /// Returns the edge length rounded to seven digits. Equal lengths then remain equal despite
  /// rounding errors, and the passes order such edges by index, the same on every processor.
  double edge_length(Index h) const {
    return rounded_to_seven_digits((at(net.origin(h)) - at(net.target(h))).norm());
  }
  double wanted_length(Index a, Index b) const { return 0.5 * (lengths[a] + lengths[b]); }
  std::array<Eigen::Vector3d, 3> triangle(Index h) const {
    return {at(net.origin(h)), at(net.target(h)), at(net.apex(h))};
  }

  /// Returns the line of `v`, a vertex of kind `line`.
  Index line_of(Index v) const;
  /// Returns the area-weighted normal of the triangles around `v`, of unit length or zero.
  Eigen::Vector3d normal_at(Index v) const;
  /// Returns the point of the original sheet or line of `v` that is closest to `point`. Changes
  /// only the hint of `v`.
  Eigen::Vector3d project(Index v, const Eigen::Vector3d& point, const Eigen::Vector3d& normal);

  /// Returns whether the edges of `line` at `v`, except the edge to `except`, remain within
  /// `length` / 10 of the original line if `v` moves to `place`.
  bool line_stays_near(Index line, Index v, Index except, const Eigen::Vector3d& place,
                       double length) const;

  /// Returns whether two vertices are copies of one mesh vertex.
  bool is_same(Index a, Index b) const;
  /// Returns whether the mesh has an edge between `a` and `b`, in the patch or outside.
  bool are_joined(Index a, Index b) const;

 private:
  Index mesh_vertex(Index v) const {
    return v < original.mesh_vertices.size() ? original.mesh_vertices[v] : kNoIndex;
  }
  Index next_copy(Index v) const {
    return v < original.next_copy.size() ? original.next_copy[v] : v;
  }
};

/// Returns 4 sqrt(3) area / (sum of the squared edge lengths). It is 1 for an equilateral triangle
/// and 0 for a degenerate one.
double triangle_quality(const std::array<Eigen::Vector3d, 3>& corners);

/// Decides whether new triangles may replace old ones: no triangle may rotate by more than 60
/// degrees, and the worst quality must be good enough or not worse than before. Call `add` for each
/// pair of triangles, then `passes`.
class ReplacementCheck {
 public:
  /// `fallback` is the normal of old triangles that are degenerate.
  explicit ReplacementCheck(const Eigen::Vector3d& fallback) : fallback_(fallback) {}
  void add(const std::array<Eigen::Vector3d, 3>& before,
           const std::array<Eigen::Vector3d, 3>& after);
  bool passes() const;

 private:
  Eigen::Vector3d fallback_;
  double worst_before_ = 1.0;
  double worst_after_ = 1.0;
  bool turned_ = false;
};

}  // namespace lapwing::remeshing
