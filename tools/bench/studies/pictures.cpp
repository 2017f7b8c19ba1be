#include "studies/pictures.h"

#include "lapwing/render/render_image.h"
#include "lapwing/vulkan/vulkan_surface.h"

namespace lapwing::bench {

PictureMaker::PictureMaker(std::filesystem::path folder)
    : folder_(std::move(folder)), kernels_(VulkanOptions{}) {
  std::filesystem::create_directories(folder_);
}

void PictureMaker::write(std::string name, const Mesh& mesh,
                         std::span<const Eigen::Vector3d> positions, const ViewAxes& axes) {
  std::erase(name, ',');
  std::replace(name.begin(), name.end(), ' ', '-');
  const auto surface = kernels_.make_surface({positions, mesh.topology(), {}, {}, 0});
  const auto& drawn = dynamic_cast<VulkanSurface&>(*surface);
  SurfacePaint paint(drawn);
  paint.set_polygons(mesh);
  const RenderOptions options;
  write_png(folder_ / (name + ".png"),
            render_image(drawn, paint, fit(positions, axes, options.aspect()), options));
}

}  // namespace lapwing::bench
