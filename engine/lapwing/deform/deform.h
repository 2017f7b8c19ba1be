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

/// Carries `request` out on `mesh`, whatever its faces. Seams are joined for it, as the request
/// says: a vertex on one stands for all that are one with it, which come out where it does, and the
/// polygons are those of `mesh`. The processor computes it; one call prepares anew, so that whoever
/// edits one region again and again keeps a DeformSolver. Throws InputError for a request that does
/// not fit the mesh, and what DeformSolver throws.
Deformed deform(Mesh mesh, const DeformRequest& request);

/// The same for the triangles `F` (m x 3 vertex numbers) with positions `V` (n x 3). The result's
/// positions are `vertex_matrix(result.mesh)`.
Deformed deform(const Eigen::Ref<const Eigen::MatrixX3d>& V,
                const Eigen::Ref<const Eigen::MatrixX3i>& F, const DeformRequest& request);

/// What the regions of a request came to.
struct ResolvedRegion {
  DeformRequest request;  ///< its handles unmoved
  Positions rest;
  EditRegion region;
};

/// What one request leaves for another on the same mesh.
struct DeformWorkspace {
  std::optional<ResolvedRegion> resolved = {};    ///< for the same regions
  std::unique_ptr<PreparedRegion> prepared = {};  ///< for the same ROI
  std::optional<DeformSolver> solver = {};        ///< for all the same but the handles' motions
  std::optional<JoinedSurface> joined = {};       ///< once seams were looked for
};

/// The same on any device. `kernels` and a mesh that shares the faces of `mesh` (the result is
/// one) must outlive `workspace`. Stages reported: "mirror" where there is one, "region", those of
/// DeformSolver, "solve", with several parts "certify".
Deformed deform(Mesh mesh, const DeformRequest& request, Kernels& kernels,
                DeformWorkspace& workspace, const Progress& progress = {});

}  // namespace lapwing
