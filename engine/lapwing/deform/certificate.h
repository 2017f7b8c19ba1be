#pragma once

#include <array>
#include <span>
#include <vector>

#include "lapwing/mesh/topology.h"
#include "lapwing/region/edit_region.h"

namespace lapwing {

/// The quality of a deformation, measured on its result.
struct Certificate {
  /// The relative residual |N u - b| / |b| of the linear system, in 2-norms. 0 if nothing moves,
  /// and with settling.
  double relative_residual = 0.0;
  /// MinimizerResult::relative_gradient of the minimization; 0 without settling.
  double relative_gradient = 0.0;
  /// The largest distance of a handle vertex from its prescribed position, in mesh units.
  double handle_error = 0.0;
  /// The largest prescribed displacement of a handle vertex or target, in mesh units; the sum over
  /// all substeps of an edit.
  double prescribed_motion = 0.0;
  /// The diagonal of the bounding box of the surface at rest, without isolated vertices. It is 0 if
  /// nothing was measured.
  double rest_diagonal = 0.0;
  /// The largest distance of a target's point from its prescribed position, in mesh units.
  double target_error = 0.0;
  /// Smallest and largest scale s_i of the best-fitting similarities s_i R_i of the region's rings;
  /// 1 means no change of size. For small angles, s_i is the s of T_i in eq. 8.
  double smallest_scale = 1.0;
  double largest_scale = 1.0;
  Index smallest_scale_vertex = kNoIndex;
  Index largest_scale_vertex = kNoIndex;
  /// The largest rotation angle of a ring, in degrees from 0 to 180.
  double largest_rotation_degrees = 0.0;
  Index largest_rotation_vertex = kNoIndex;
  /// The number of triangles whose normal points away from the rest normal, rotated by the mean
  /// rotation of the corners. Triangles thinner than kThinnestTriangle at rest are not counted. The
  /// list contains the first kListedTriangles flipped triangles.
  std::size_t flipped_triangles = 0;
  std::vector<Index> first_flipped_triangles;
  /// The fraction of the region's area that is inside out (`measure_inversion`), and a vertex in
  /// that area. It is measured only if triangles are flipped or a ring has turned by more than 90
  /// degrees.
  double inside_out_share = 0.0;
  Index inside_out_vertex = kNoIndex;
  /// True if the region consists of whole connected components of the mesh.
  bool region_is_whole = false;
  /// The function `detail_error`, evaluated over the free vertices. It is 0 if details are
  /// preserved, 1 if they are lost, and NaN if the surface has no details.
  double detail_error = 0.0;
  /// The `edge_stretch` of the region, and the largest stretch of a single edge with the two
  /// vertices of that edge. The vertices are kNoIndex if no edge changes its length.
  double edge_stretch = 0.0;
  double largest_edge_stretch = 0.0;
  std::array<Index, 2> largest_edge_stretch_vertices{kNoIndex, kNoIndex};
  int settle_iterations = 0;      ///< 0 without settling
  bool settled = true;            ///< false if `max_iterations` was reached first
  bool lacks_hessian = false;     ///< MinimizerResult::lacks_hessian
  double settle_last_step = 0.0;  ///< MinimizerResult::last_step, in mean edge lengths
  bool all_finite = true;
};

/// `require_valid` throws if the relative residual is larger.
inline constexpr double kLargestResidual = 1e-6;

/// The smallest ratio of height to longest side for which flipped triangles are counted. Any
/// bending flips thinner triangles.
inline constexpr double kThinnestTriangle = 1e-3;

/// Largest length of Certificate::first_flipped_triangles.
inline constexpr std::size_t kListedTriangles = 8;

/// Sets the measurements that depend only on the rest shape and the current shape: size, scales,
/// rotations, flipped triangles and edge stretch. Measures the vertices of `roi` and the triangles
/// that touch them. If the pose is not finite, sets only `all_finite`. `asked` is the prescribed
/// rest stretch, as `stretch` in `detail_error`. Returns the rotation of each ring, one per vertex
/// of the mesh. Takes linear time.
std::vector<Eigen::Matrix3d> measure_shape(std::span<const Index> roi, const Topology& topology,
                                           std::span<const Eigen::Vector3d> rest,
                                           std::span<const Eigen::Vector3d> current,
                                           Certificate& certificate,
                                           std::span<const Eigen::Matrix3d> asked = {});

/// Like `measure_shape` for the region of an edit. Also sets the detail error over the region's
/// free vertices. `weights` are the Laplacian weights.
void measure_region(const EditRegion& region, const Topology& topology,
                    std::span<const double> weights, std::span<const Eigen::Vector3d> rest,
                    std::span<const Eigen::Vector3d> current, Certificate& certificate,
                    std::span<const Eigen::Matrix3d> asked = {});

/// Throws SolverError, with advice, if a position or measured distance is not finite, or if the
/// residual exceeds kLargestResidual.
void require_valid(const Certificate& certificate);

}  // namespace lapwing
