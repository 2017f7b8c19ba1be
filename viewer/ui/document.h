#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "lapwing/render/surface_paint.h"
#include "lapwing/vulkan/vulkan_kernels.h"
#include "lapwing/vulkan/vulkan_surface.h"
#include "ui/load_file.h"

namespace lapwing::viewer {

/// What is open: a mesh and its surface on the device.
struct Document {
  Document(LoadedFile loaded, VulkanKernels& kernels)
      : file(std::move(loaded)),
        bounds(bounds_of(file.mesh.positions)),
        made(kernels.make_surface({file.mesh.positions, file.topology, {}, {}, 0})),
        surface(dynamic_cast<VulkanSurface&>(*made)),
        paint(surface) {
    paint.set_polygons(file.mesh, file.topology);
    if (!file.classes.empty()) paint.set_classes(file.classes);
    if (file.rest.empty()) return;
    std::vector<float> distances;
    for (std::size_t v = 0; v < file.rest.size(); ++v) {
      distances.push_back(static_cast<float>((file.mesh.positions[v] - file.rest[v]).norm()));
    }
    paint.set_scalars(distances);
  }

  LoadedFile file;
  Bounds bounds;
  std::unique_ptr<DeformedSurface> made;
  VulkanSurface& surface;
  SurfacePaint paint;  ///< its numbers are how far a recipe moved each vertex
};

}  // namespace lapwing::viewer
