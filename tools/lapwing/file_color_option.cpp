#include "file_color_option.h"

#include "lapwing/render/mip_levels.h"

namespace lapwing::cli {

std::vector<std::string> color_by_file(const Mesh& mesh, const std::filesystem::path& path,
                                       SurfacePaint& paint, RenderOptions& options) {
  FileColors colors = read_file_colors(mesh, path);
  paint.set_file_colors(mesh, colors, mip_levels(colors.images));
  options.style.file_colors = true;
  return std::move(colors.notes);
}

}  // namespace lapwing::cli
