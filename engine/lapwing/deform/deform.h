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
  double turn_degrees = 0.0;  ///< largest turn of a handle in the request, e.g. 260
  /// The accumulated rotation of the surface about the same axis (winding.h).
  std::optional<double> winding_degrees = {};
  std::size_t commits = 1;  ///< number of parts; the result of each is the rest shape of the next
  /// Measured from the surface before the request to the one after it. Residual and settling are
  /// the worst of the parts, iterations their sum.
  Certificate certificate;
};

/// The result of `deform`. `vertex_motion` computes how each vertex moved and turned.
struct Deformed : DeformReport {
  Mesh mesh;  ///< the input mesh with new positions
  /// Messages for the user: what is wrong, where, and what to change. Empty for a good result.
  std::vector<std::string> warnings;
  /// Harmless messages for the user: what was done beyond the literal request.
  std::vector<std::string> notes;
  EditRegion region;  ///< the request's regions, resolved to vertices
  /// The stretch S_i that scaling handles ask of the surface, per vertex: symmetric and positive
  /// definite, the identity outside the region. Empty if no handle changes its size.
  std::vector<Eigen::Matrix3d> rest_stretch;
  StageTimings timings;  ///< of all parts together
};

/// Carries out `request` on a polygon mesh, on the CPU. Coincident vertices along seams move
/// together unless the request says otherwise. The polygons of `mesh` do not change. Use
/// DeformSolver for repeated edits of one region. Throws InputError for a request that does not fit
/// the mesh. Also throws the errors of DeformSolver.
Deformed deform(Mesh mesh, const DeformRequest& request);

/// The same for the triangles `F` (m x 3 vertex numbers) with positions `V` (n x 3). The result's
/// positions are `vertex_matrix(result.mesh)`.
Deformed deform(const Eigen::Ref<const Eigen::MatrixX3d>& V,
                const Eigen::Ref<const Eigen::MatrixX3i>& F, const DeformRequest& request);

/// The resolved regions of a request.
struct ResolvedRegion {
  DeformRequest request;  ///< its handles unmoved
  Positions rest;
  EditRegion region;
};

/// Data that a request leaves for the next one on the same mesh.
struct DeformWorkspace {
  std::optional<ResolvedRegion> resolved = {};    ///< for the same regions
  std::unique_ptr<PreparedRegion> prepared = {};  ///< for the same ROI
  std::optional<DeformSolver> solver = {};        ///< if only the handles' motions differ
  std::optional<JoinedSurface> joined = {};       ///< set after the search for seams
};

/// The same on any device. `kernels` must outlive `workspace`. A mesh with the topology of `mesh`,
/// for example the result, must also outlive it. Reports the stages "mirror", "region", those of
/// DeformSolver, "solve", and "certify" if the edit is split into substeps.
Deformed deform(Mesh mesh, const DeformRequest& request, Kernels& kernels,
                DeformWorkspace& workspace, const Progress& progress = {});

}  // namespace lapwing
