#pragma once

#include <memory>
#include <vector>

#include <Eigen/Core>

#include "lapwing/deform/modifiers/mirrored_request.h"
#include "state/edit_selection.h"

namespace lapwing::viewer {

/// An edit with a mirror, on both sides of the plane.
struct MirroredEdit {
  EditRegion region;                       ///< for the DeformSolver
  std::vector<std::size_t> handle_images;  ///< as in MirroredRequest
  std::vector<Eigen::Vector3d> centroids;  ///< of the region's handles, which turn about them
};

/// Mirrors `step`, which has a mirror, on `mesh`. Returns null if it is not complete yet.
std::shared_ptr<const MirroredEdit> mirrored_edit(const DeformRequest& step, const Mesh& mesh);

}  // namespace lapwing::viewer
