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
  /// Of the linear response, where nothing settles: |N u - b| / |b| of its equations (2-norms); 0
  /// when nothing moves, and of a settled surface.
  double relative_residual = 0.0;
  /// Of a settled surface: MinimizerResult::relative_gradient, what of the energy's pull is not in
  /// balance, over the force of the handles.
  double relative_gradient = 0.0;
  /// Largest distance between where a handle vertex is and where the motion wants it, mesh units.
  /// Not zero with soft constraints: they share the error with the surface.
  double handle_error = 0.0;
  /// The largest distance that a handle vertex or target was to go, mesh units; of an edit in parts
  /// the sum.
  double asked_motion = 0.0;
  /// Of the bounds of the mesh at rest; 0 where nothing was measured.
  double rest_diagonal = 0.0;
  /// The largest distance between a target's point and where it is to go, mesh units.
  double target_error = 0.0;
  /// Smallest and largest scale s_i of a ring's best similarity s_i R_i over the region; 1 is no
  /// change of size. For small angles the s of T_i in eq. 8.
  double smallest_scale = 1.0;
  double largest_scale = 1.0;
  Index smallest_scale_vertex = kNoIndex;
  Index largest_scale_vertex = kNoIndex;
  /// Largest angle by which a ring has turned, in degrees, 0 to 180.
  double largest_rotation_degrees = 0.0;
  Index largest_rotation_vertex = kNoIndex;
  /// Triangles that face against the turned rest normal of their corners; those thinner than
  /// kThinnestTriangle at rest have no side to face to. First few by number.
  std::size_t flipped_triangles = 0;
  std::vector<Index> first_flipped_triangles;
  /// What of the region is inside out, by area (`measure_inversion`), looked for if triangles are
  /// flipped or a ring has turned by more than 90 degrees: 0 to 1, and a vertex there.
  double inside_out_share = 0.0;
  Index inside_out_vertex = kNoIndex;
  /// Whether the region is all of the mesh that is connected to it.
  bool region_is_whole = false;
  /// How far details are from their rest shapes turned with their rings and scaled as the handles
  /// ask, relative to their size, over the free vertices (`detail_error`); 0 is none lost, 1 all.
  double detail_error = 0.0;
  /// Root mean square of the relative change of edge lengths in the region, beyond what the handles
  /// ask for (`edge_stretch`).
  double edge_stretch = 0.0;
  /// The largest such change, and the ends of its edge; none where all lengths are kept.
  double largest_edge_stretch = 0.0;
  std::array<Index, 2> largest_edge_stretch_vertices{kNoIndex, kNoIndex};
  int settle_iterations = 0;      ///< 0 without settling
  bool settled = true;            ///< false where the iterations ran out first
  bool lacks_hessian = false;     ///< MinimizerResult::lacks_hessian
  double settle_last_step = 0.0;  ///< how far a vertex would still move, in mean edge lengths
  bool all_finite = true;
};

/// A residual above this is not a solution of the system; the result is then refused.
inline constexpr double kLargestResidual = 1e-6;

/// A triangle less high than this, relative to its longest side, is turned over by any bend.
inline constexpr double kThinnestTriangle = 1e-3;

/// At this many flipped triangles the list stops.
inline constexpr std::size_t kListedTriangles = 8;

/// A surface of which more than this is inside out is worth a warning of its own.
inline constexpr double kMostInsideOut = 0.01;

/// An edge that became longer than this, times what the handles ask for, is worth a warning.
inline constexpr double kLongEdge = 3.0;

/// A handle that misses its place by more than this part of the mesh's diagonal is worth a warning:
/// about 8 pixels of a window that shows all of it.
inline constexpr double kMostHandleMiss = 0.01;

/// And so is one that misses it by more than this part of its way, which counts where regions are
/// small beside their mesh. Soft handles of default weight miss by a hundredth of it, on the
/// coarsest meshes by a tenth.
inline constexpr double kMostHandleLag = 0.25;

/// Whether a handle is farther from its place than those two allow.
bool misses_handles(const Certificate& certificate);

/// Fills in what can be measured from the shapes alone: size, scales, rotations, flips, edge
/// stretch, finiteness; of a pose that is not finite that alone. `roi` are the vertices measured;
/// triangles count when they touch it. `asked` is the rest stretch that the handles ask for, as in
/// `detail_error`. Linear time.
void measure_shape(std::span<const Index> roi, const Topology& topology,
                   std::span<const Eigen::Vector3d> rest, std::span<const Eigen::Vector3d> current,
                   Certificate& certificate, std::span<const Eigen::Matrix3d> asked = {});

/// The same for an edit's region, with the detail error over its free vertices (`weights` are those
/// of the Laplacians).
void measure_region(const EditRegion& region, const Topology& topology,
                    std::span<const double> weights, std::span<const Eigen::Vector3d> rest,
                    std::span<const Eigen::Vector3d> current, Certificate& certificate,
                    std::span<const Eigen::Matrix3d> asked = {});

/// What whoever gets this surface should know, each with its place and what to do: not settled,
/// handles that miss their places, flipped triangles, an edge longer than kLongEdge times its
/// length. Nothing for a good one.
std::vector<std::string> warnings_of(const Certificate& certificate);

/// Throws SolverError, saying what is wrong and what to try, unless the certificate holds:
/// positions and distances finite, and residual at most kLargestResidual.
void require_valid(const Certificate& certificate);

}  // namespace lapwing
