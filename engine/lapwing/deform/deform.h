#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/stopwatch.h"
#include "lapwing/deform/certificate.h"
#include "lapwing/deform/deform_request.h"
#include "lapwing/deform/deform_solver.h"
#include "lapwing/deform/vertex_motion.h"
#include "lapwing/elastic/prepared_region.h"
#include "lapwing/kernels/kernels.h"
#include "lapwing/mesh/matrices.h"
#include "lapwing/mesh/mesh.h"
#include "lapwing/mesh/seams.h"
#include "lapwing/region/edit_region.h"

namespace lapwing {

/// How a deformation was computed, and its quality.
struct DeformReport {
  std::string solver;
  double turn_degrees = 0.0;  ///< largest turn of a handle in the request, for example 260
  /// The accumulated rotation of the surface about the axis of that turn (winding.h).
  std::optional<double> winding_degrees = {};
  /// Number of substeps; the result of each is the rest shape of the next.
  std::size_t commits = 1;
  /// Compares the surfaces before and after the request. Residual and settling are the worst of all
  /// substeps; iterations are the sum.
  Certificate certificate;
};

/// The result of `deform`. `vertex_motion` computes how each vertex moved and turned.
struct Deformed : DeformReport {
  Mesh mesh;  ///< the input mesh with new positions
  /// Messages for the user, each with a problem, its location and a remedy. Empty for a good
  /// result.
  std::vector<std::string> warnings;
  /// Messages for the user about choices that the request did not specify.
  std::vector<std::string> notes;
  EditRegion region;  ///< the request's regions, resolved to vertices
  /// The stretch S_i that scaling handles prescribe, per vertex: symmetric and positive definite;
  /// the identity outside the region. Empty if no handle changes its size.
  std::vector<Eigen::Matrix3d> rest_stretch;
  StageTimings timings;  ///< the sums over all substeps
};

/// Carries out `request` on a polygon mesh, on the CPU. Coincident vertices along seams move
/// together unless the request says otherwise. The polygons of `mesh` do not change. Use
/// DeformSolver for repeated edits of one region. Throws InputError for a request that does not fit
/// the mesh. Also throws the errors of DeformSolver.
Deformed deform(Mesh mesh, const DeformRequest& request);

/// Deforms the mesh with triangles `F` (m x 3 vertex numbers) and positions `V` (n x 3). The
/// result's positions are `vertex_matrix(result.mesh)`.
Deformed deform(const Eigen::Ref<const Eigen::MatrixX3d>& V,
                const Eigen::Ref<const Eigen::MatrixX3i>& F, const DeformRequest& request);

/// The resolved regions of a request.
struct ResolvedRegion {
  DeformRequest request;  ///< with the moves of all handles removed
  Positions rest;
  EditRegion region;
};

/// Data of a request that the next request on the same mesh can reuse.
struct DeformWorkspace {
  std::optional<ResolvedRegion> resolved = {};    ///< reused if the regions are the same
  std::unique_ptr<PreparedRegion> prepared = {};  ///< reused if the ROI is the same
  std::optional<DeformSolver> solver = {};        ///< reused if only the handles' motions differ
  std::optional<JoinedSurface> joined = {};       ///< set after the search for seams
};

/// Like `deform` above, on any device. `kernels` must outlive `workspace`. A mesh that shares the
/// topology of `mesh`, for example the result, must also outlive `workspace`. Reports the stages
/// "mirror", "region", those of DeformSolver, "solve", and "certify" if the edit is split into
/// substeps.
Deformed deform(Mesh mesh, const DeformRequest& request, Kernels& kernels,
                DeformWorkspace& workspace, const Progress& progress = {});

}  // namespace lapwing
