#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "lapwing/gpu/context.h"
#include "lapwing/mesh/mesh.h"
#include "lapwing/render/camera.h"

namespace lapwing::bench {

/// Writes pictures of results into a folder, for someone to look at.
class PictureMaker {
 public:
  /// Makes the folder. Throws GpuError without a Vulkan device.
  explicit PictureMaker(std::filesystem::path folder);

  /// NAME.png: `mesh` with its vertices at `positions`, dashes for the spaces of the name, no
  /// commas.
  void write(std::string name, const Mesh& mesh, std::span<const Eigen::Vector3d> positions,
             const ViewAxes& axes);

 private:
  std::filesystem::path folder_;
  std::shared_ptr<gpu::Context> context_;
};

}  // namespace lapwing::bench
