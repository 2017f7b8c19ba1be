#include "studies/pictures.h"

#include "lapwing/render/render_image.h"
#include "lapwing/render/surface.h"

namespace lapwing::bench {

PictureWriter::PictureWriter(std::filesystem::path folder)
    : folder_(std::move(folder)), context_(std::make_shared<gpu::Context>()) {
  std::filesystem::create_directories(folder_);
}

void PictureWriter::write(std::string name, const Mesh& mesh,
                          std::span<const Eigen::Vector3d> positions, const ViewAxes& axes) {
  std::erase(name, ',');
  std::replace(name.begin(), name.end(), ' ', '-');
  Surface surface(context_, positions, mesh.topology());
  SurfacePaint paint(surface);
  paint.set_polygons(mesh);
  const RenderOptions options;
  write_png(folder_ / (name + ".png"),
            render_image(surface, paint, fit(positions, axes, options.aspect()), options));
}

}  // namespace lapwing::bench
