#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lapwing/mesh/mesh.h"
#include "lapwing/render/render_image.h"

namespace lapwing::cli {

// What --color takes beside what a mesh differs by (pose_colors.h).
inline const std::string kFileColor = "file";    ///< the colours of the mesh's file
inline const std::string kPlainColor = "plain";  ///< clay

/// Colours `paint`, of the triangles of `mesh`, by what its file at `path` says, where that says
/// something. Returns what could not be read, and what to do.
std::vector<std::string> color_by_file(const Mesh& mesh, const std::filesystem::path& path,
                                       SurfacePaint& paint, RenderOptions& options);

}  // namespace lapwing::cli
