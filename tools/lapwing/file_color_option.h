#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lapwing/mesh/mesh.h"
#include "lapwing/render/render_image.h"

namespace lapwing::cli {

// Values of --color in addition to those of pose_colors.h.
inline const std::string kFileColor = "file";    ///< the colours of the mesh's file
inline const std::string kPlainColor = "plain";  ///< clay

/// Colours `paint`, of the triangles of `mesh`, with the colours of its file at `path`, if there
/// are any. Returns what could not be read, and the remedy.
std::vector<std::string> color_by_file(const Mesh& mesh, const std::filesystem::path& path,
                                       SurfacePaint& paint, RenderOptions& options);

}  // namespace lapwing::cli
