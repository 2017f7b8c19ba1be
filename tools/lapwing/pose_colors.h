#pragma once

#include <span>
#include <string>
#include <vector>

#include "lapwing/mesh/mesh.h"
#include "lapwing/render/render_image.h"

namespace lapwing::cli {

/// What a picture can show of how a pose differs from its rest pose, as written after --color:
/// displacement, rotation, detail (of uniform Laplacians) and stretch.
const std::vector<std::string>& pose_colors();

/// Colours `paint` by how `mesh` differs from its vertices at `rest`: by `measure`, one of
/// `pose_colors()`, and sets range and legend to match. The range begins at 0 and leaves outliers
/// out. Vertices that are where they were with their rings have no colour. Seams that are closed in
/// both poses are none.
void color_by(const std::string& measure, const Mesh& mesh, std::span<const Eigen::Vector3d> rest,
              SurfacePaint& paint, RenderOptions& options);

}  // namespace lapwing::cli
