#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lapwing/base/cancellation.h"
#include "lapwing/deform/modifiers/mirror.h"
#include "lapwing/deform/shape_measures.h"
#include "lapwing/kernels/kernels.h"
#include "lapwing/mesh/closest_point.h"
#include "lapwing/mesh/mesh.h"
#include "lapwing/region/stiffness.h"
#include "lapwing/region/targets.h"
#include "lapwing/wrap/alignment.h"

namespace lapwing {

struct WrapRequest {
  /// Points of the template and their positions on the scan. If they are `hard`, they are reached
  /// within a millionth of an edge length. `file` has no effect.
  TargetSpec landmarks = {.where = "landmarks"};
  bool aligned = false;  ///< the template is already in place; do not align it first
  /// Parts of the template that bend less or more than the rest.
  std::vector<StiffnessSpec> stiffness = {};
  /// The template's plane of symmetry. If given, the result is symmetric about the plane to which
  /// the alignment maps it.
  std::optional<MirrorSpec> mirror = {};
  /// At the end, moves each vertex that has a counterpart to the closest point of the scan.
  bool detail = false;
  bool operator==(const WrapRequest&) const = default;
};

/// Distances from the points of one surface to another, in the unit of the scan.
struct SurfaceDistance {
  double mean = 0.0;
  double percentile_95 = 0.0;
  double max = 0.0;
};

struct WrapReport {
  Alignment alignment;
  SurfaceDistance to_scan;      ///< from the vertices of the result
  SurfaceDistance to_template;  ///< from points that are spread evenly over the scan
  /// The fraction of the template's area that has a counterpart on the scan.
  double coverage = 0.0;
  double landmark_error = 0.0;  ///< the largest distance of a landmark from its position
  /// Index of this landmark in the request.
  std::size_t farthest_landmark = 0;
  std::size_t flipped_triangles = 0;
  double edge_stretch = 0.0;  ///< the root mean square over all edges, as in Certificate
  StretchedEdge most_stretched;
  int steps = 0;  ///< number of minimizations
};

struct Wrapped {
  Positions positions;  ///< of the template's vertices
  /// For each vertex of the template, its counterpart on the scan (triangles of the scan's
  /// topology, or a vertex of a point cloud), or `nowhere()`.
  std::vector<SurfacePoint> counterparts;
  /// For each vertex of the template, its distance from the scan; NaN without triangles.
  std::vector<float> distances;
  WrapReport report;
};

/// Deforms a template so that it covers a scan (non-rigid registration).
///
/// The template is aligned by a similarity: by its landmarks if there are three, otherwise by
/// `align_surfaces`. Springs then pull its vertices to their closest points on the scan, and points
/// of the scan pull the template, while the energy of ENERGY.md, section 3, preserves the shape of
/// the template. The springs are soft at first, so that they cause only deformations of long
/// wavelength. They become stiffer step by step, until wavelengths of about an edge length follow
/// them (Amberg, Romdhani, Vetter 2007). Pairs whose normals disagree, that end at a boundary of
/// the scan, or that are far apart compared with the others pull little or nothing.
///
/// Parts of the template without a counterpart keep their shape and follow the rest. Landmarks are
/// prescribed from the first step on. With `mirror`, the scan and its mirror image pull the
/// template equally, and each pose is made exactly symmetric. With `detail`, a last minimization
/// prescribes the closest points, and only vertices without a counterpart are free. All triangles
/// of both meshes must be consistently oriented outward. The scan may be a point cloud with
/// normals: a mesh without faces and with one stored normal per vertex.
///
/// Runs about forty minimizations. Reports the stages "align" and "wrap". Throws InputError if a
/// mesh has no surface, and the errors of `resolve_targets`, `align_points`, `align_surfaces` and
/// `TemplateMirror`. Also throws SolverError, GpuError and Cancelled.
Wrapped wrap(const Mesh& wrapped, const Mesh& scan, const WrapRequest& request, Kernels& kernels,
             const Progress& progress = {});

/// Returns the counterpart of each vertex of a surface that covers the scan, or `nowhere()`. The
/// counterpart is the closest point if the normals agree, if it is not on a boundary, and if it is
/// not much farther away than most. For `Wrapped::positions` the result is `Wrapped::counterparts`.
/// O(n log n). Throws InputError if the scan has no surface.
std::vector<SurfacePoint> counterparts_on(const Mesh& scan, const Topology& topology,
                                          std::span<const Eigen::Vector3d> positions);

/// Returns an empty string if a result is usable, otherwise the reason why it is not and a
/// suggestion. A result is not usable if less than half of the template has a counterpart, the
/// edge stretch exceeds a half, or more than a thousandth of the triangles are flipped.
std::string why_failed(const WrapReport& report, std::size_t triangle_count);

}  // namespace lapwing
