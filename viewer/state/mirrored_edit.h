#pragma once

#include <memory>
#include <vector>

#include <Eigen/Core>

#include "lapwing/deform/modifiers/mirrored_request.h"
#include "state/edit_selection.h"

namespace lapwing::viewer {

/// What an edit with a mirror comes to on both sides of the plane.
struct MirroredEdit {
  EditRegion region;                       ///< what the DeformSolver is prepared with
  std::vector<std::size_t> handle_images;  ///< as MirroredRequest has them
  std::vector<Eigen::Vector3d> centroids;  ///< of the region's handles, about which they turn
};

/// `step`, which has a mirror, on `mesh`. Null where it cannot be carried out yet.
std::shared_ptr<const MirroredEdit> mirrored_edit(const DeformRequest& step, const Mesh& mesh);

}  // namespace lapwing::viewer
