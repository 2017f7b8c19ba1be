#pragma once

#include <span>
#include <string>
#include <vector>

#include "lapwing/mesh/mesh.h"
#include "lapwing/render/render_image.h"

namespace lapwing::cli {

/// Values of --color that compare a pose with its rest pose: displacement, rotation, detail (of
/// uniform Laplacians) and stretch.
const std::vector<std::string>& pose_colors();

/// Colours `paint` by the difference between `mesh` and its vertices at `rest`. `measure` is one of
/// `pose_colors()`; range and legend are set to match. The range begins at 0 and excludes outliers.
/// Vertices whose rings did not move have no colour. Seams that are closed in both poses are
/// treated as joined.
void color_by(const std::string& measure, const Mesh& mesh, std::span<const Eigen::Vector3d> rest,
              SurfacePaint& paint, RenderOptions& options);

}  // namespace lapwing::cli
