#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "lapwing/gpu/context.h"
#include "lapwing/mesh/mesh.h"
#include "lapwing/render/camera.h"

namespace lapwing::bench {

/// Writes pictures of results into a folder.
class PictureWriter {
 public:
  /// Creates the folder. Throws GpuError if there is no Vulkan device.
  explicit PictureWriter(std::filesystem::path folder);

  /// Writes NAME.png: `mesh` with its vertices at `positions`. In the file name, spaces become
  /// dashes and commas are left out.
  void write(std::string name, const Mesh& mesh, std::span<const Eigen::Vector3d> positions,
             const ViewAxes& axes);

 private:
  std::filesystem::path folder_;
  std::shared_ptr<gpu::Context> context_;
};

}  // namespace lapwing::bench
