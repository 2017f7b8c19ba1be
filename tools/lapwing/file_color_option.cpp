#include "file_color_option.h"

#include "lapwing/render/file_paint.h"

namespace lapwing::cli {

std::vector<std::string> color_by_file(const Mesh& mesh, const std::filesystem::path& path,
                                       SurfacePaint& paint, RenderOptions& options) {
  FilePaint file(read_file_colors(mesh, path));
  paint.set_file_colors(mesh, mesh, file);
  options.style.file_colors = true;
  return std::move(file.colors.notes);
}

}  // namespace lapwing::cli
