#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lapwing/base/progress.h"
#include "lapwing/base/stopwatch.h"
#include "lapwing/deform/certificate.h"
#include "lapwing/deform/deform_request.h"
#include "lapwing/deform/deform_solver.h"
#include "lapwing/deform/vertex_motion.h"
#include "lapwing/elastic/prepared_region.h"
#include "lapwing/kernels/kernels.h"
#include "lapwing/mesh/joined_surface.h"
#include "lapwing/mesh/matrices.h"
#include "lapwing/mesh/mesh.h"
#include "lapwing/region/edit_region.h"

namespace lapwing {

/// How a deform was carried out, and how well.
struct DeformReport {
  std::string solver;
  double turn_degrees = 0.0;  ///< the largest turn of a handle, as written: 260 is 260
  /// How far the surface came out wound about the same axis (winding.h).
  std::optional<double> wound_degrees = {};
  std::size_t commits = 1;  ///< parts it was carried out in, each the rest shape of the next
  /// Of all parts as one, from the surface before the request to the one after it; residual and
  /// settling are the worst of the parts, the iterations those of all.
  Certificate certificate;
};

/// What `deform` makes of a mesh. How each vertex moved and turned is a question of its own, to
/// `vertex_motion`.
struct Deformed : DeformReport {
  Mesh mesh;  ///< the one given, with other positions
  /// For a person: what is not as it should be, where, and what to change. Empty when all is well.
  std::vector<std::string> warnings;
  /// For a person, too: what was done that the request does not say by itself. No cause for worry.
  std::vector<std::string> notes;
  EditRegion region;  ///< the vertices that the request's regions chose
  /// The stretch S_i that scaling handles ask of the surface, per vertex: symmetric and positive
  /// definite, the identity outside the region. Empty if no handle changes its size.
  std::vector<Eigen::Matrix3d> rest_stretch;
  StageTimings timings;  ///< of all parts together
};

/// Carries out `request` on a mesh with any polygons, on the CPU. Coincident seam vertices are
/// joined unless the request says otherwise, and move together; the result has the polygons of
/// `mesh`. Each call prepares from scratch: use DeformSolver for repeated edits of one region.
/// Throws InputError for a request that does not fit the mesh, and what DeformSolver throws.
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

/// What one request prepares for the next one on the same mesh.
struct DeformWorkspace {
  std::optional<ResolvedRegion> resolved = {};    ///< for the same regions
  std::unique_ptr<PreparedRegion> prepared = {};  ///< for the same ROI
  std::optional<DeformSolver> solver = {};        ///< for all the same but the handles' motions
  std::optional<JoinedSurface> joined = {};       ///< once seams were looked for
};

/// The same on any device. `kernels` must outlive `workspace`, and so must one mesh that shares the
/// topology of `mesh`; the result is such a mesh. Stages reported: "mirror" if the request has one,
/// "region", those of DeformSolver, "solve", and "certify" if there are several parts.
Deformed deform(Mesh mesh, const DeformRequest& request, Kernels& kernels,
                DeformWorkspace& workspace, const Progress& progress = {});

}  // namespace lapwing
