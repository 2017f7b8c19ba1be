#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "lapwing/mesh/topology.h"
#include "lapwing/region/edit_region.h"

namespace lapwing {

/// What a result promises, measured on the result itself. Every deformation carries one.
struct Certificate {
  /// |N u - b| / |b| of the normal equations (2-norms), from whose solution settling starts; 0 when
  /// nothing moves, and where there is no such solution.
  double relative_residual = 0.0;
  /// Why settling started without one (Deformer::why_not_exact); empty otherwise.
  std::string why_not_exact;
  /// Largest distance between where a handle vertex is and where the motion wants it, mesh units.
  /// Not zero with soft constraints: they share the error with the surface.
  double handle_error = 0.0;
  /// Smallest and largest scale s_i of a ring's best similarity s_i R_i over the region; 1 is no
  /// change of size. For small angles the s of T_i in eq. 8.
  double smallest_scale = 1.0;
  double largest_scale = 1.0;
  Index smallest_scale_vertex = kNoIndex;
  Index largest_scale_vertex = kNoIndex;
  /// Largest angle by which a ring has turned, in degrees, 0 to 180.
  double largest_rotation_degrees = 0.0;
  Index largest_rotation_vertex = kNoIndex;
  /// Triangles that face against the turned rest normal of their corners. First few by number.
  std::size_t flipped_triangles = 0;
  std::vector<Index> first_flipped_triangles;
  /// How far details are from their rest shapes turned with their rings, relative to their size,
  /// over the free vertices (`detail_error`); 0 is none lost, 1 all.
  double detail_error = 0.0;
  /// Root mean square of the relative change of edge lengths in the region (`edge_stretch`).
  double edge_stretch = 0.0;
  /// The largest such change, and the ends of its edge; none where all lengths are kept.
  double largest_edge_stretch = 0.0;
  std::array<Index, 2> largest_edge_stretch_vertices{kNoIndex, kNoIndex};
  int settle_iterations = 0;      ///< 0 without settling
  bool settled = true;            ///< false where the iterations ran out first
  double settle_last_step = 0.0;  ///< how far a vertex would still move, in mean edge lengths
  bool all_finite = true;
};

/// A residual above this is not a solution of the system; the result is then refused.
inline constexpr double kLargestResidual = 1e-6;

/// At this many flipped triangles the list stops.
inline constexpr std::size_t kListedTriangles = 8;

/// Fills in what can be measured from the shapes alone: scales, rotations, flips, the edge
/// stretched most, finiteness. `roi` are the vertices measured; triangles count when they touch it.
/// Linear time.
void measure_shape(std::span<const Index> roi, const Topology& topology,
                   std::span<const Eigen::Vector3d> rest, std::span<const Eigen::Vector3d> current,
                   Certificate& certificate);

/// The same for an edit's region, with the detail error over its free vertices (`weights` are those
/// of the Laplacians) and the edge stretch.
void measure_region(const EditRegion& region, const Topology& topology,
                    std::span<const double> weights, std::span<const Eigen::Vector3d> rest,
                    std::span<const Eigen::Vector3d> current, Certificate& certificate);

/// Throws SolverError, saying what is wrong and what to try, unless the certificate holds: finite,
/// and residual at most kLargestResidual.
void require_valid(const Certificate& certificate);

}  // namespace lapwing
