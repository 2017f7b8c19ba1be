#pragma once

#include <vector>

#include "lapwing/base/numbers.h"
#include "lapwing/closest/closest_point.h"
#include "lapwing/remesh/original_patch.h"
#include "lapwing/remesh/target_length.h"

namespace lapwing::remeshing {

/// A point on a line of the original patch: `along` of the way from the origin of `halfedge`, one
/// of the line's, to its target.
struct LinePoint {
  Index halfedge = kNoIndex;
  double along = 0.0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Index hint = kNoIndex;  ///< for the next search close by on the same line
};

/// The original patch as what vertices are put back onto.
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

/// Cosines, angles and qualities that differ by less are equal but for rounding, for example when a
/// vertex moves within the plane of its triangles. What is equal is no reason to decide otherwise.
inline constexpr double kSameQuality = 1e-9;

/// The patch while it is remeshed. Vertices of the original keep their own numbers as long as they
/// are there; new ones follow.
struct WorkingPatch {
  WorkingPatch(const OriginalPatch& original_patch, const TargetLength& target,
               std::vector<double> lengths_at_vertices);

  const OriginalPatch& original;
  const TargetLength& target_length;
  Reference reference;
  Halfedges net;
  Positions positions;
  std::vector<double> lengths;  ///< per vertex: the target there
  std::vector<VertexKind> kinds;
  std::vector<Index> hints;     ///< per vertex: for `project`
  std::vector<Index> sheet_of;  ///< per triangle

  const Eigen::Vector3d& at(Index v) const { return positions[v]; }
  /// Rounded to seven digits: edges of equal length then compare equal in spite of rounding, and
  /// the passes choose among them by number, the same on every processor.
  double edge_length(Index h) const {
    return rounded_to_seven_digits((at(net.origin(h)) - at(net.target(h))).norm());
  }
  double wanted_length(Index a, Index b) const { return 0.5 * (lengths[a] + lengths[b]); }
  std::array<Eigen::Vector3d, 3> triangle(Index h) const {
    return {at(net.origin(h)), at(net.target(h)), at(net.apex(h))};
  }

  /// The line that a vertex of kind `line` is on.
  Index line_of(Index v) const;
  /// Area-weighted normal of the triangles around `v`, of unit length or zero.
  Eigen::Vector3d normal_at(Index v) const;
  /// The point of the original surface, or of its line, that is closest to `point` for `v`. Writes
  /// what belongs to `v` alone.
  Eigen::Vector3d project(Index v, const Eigen::Vector3d& point, const Eigen::Vector3d& normal);

  /// Whether the edges of `line` at `v`, but the one to `except`, run within a tenth of `length` of
  /// where the line was, when `v` moves to `place`.
  bool line_stays_near(Index line, Index v, Index except, const Eigen::Vector3d& place,
                       double length) const;

  /// Whether two vertices are the same vertex of the mesh.
  bool is_same(Index a, Index b) const;
  /// Whether the mesh has an edge between the two, in the patch or outside.
  bool are_joined(Index a, Index b) const;

 private:
  Index mesh_vertex(Index v) const {
    return v < original.mesh_vertices.size() ? original.mesh_vertices[v] : kNoIndex;
  }
  Index next_copy(Index v) const {
    return v < original.next_copy.size() ? original.next_copy[v] : v;
  }
};

/// 4 sqrt(3) times the area over the sum of the squared sides: 1 for an equilateral triangle, 0
/// without area.
double triangle_quality(const std::array<Eigen::Vector3d, 3>& corners);

/// Whether triangles may replace others: none turns by more than 60 degrees, and the worst of them
/// is good enough or no worse than the worst before. Feed pairs, then ask.
class ReplacementCheck {
 public:
  /// `fallback`: which way a triangle looks that had no area.
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
