#include "lapwing/render/point_cloud.h"

#include <utility>
#include <vector>

#include "lapwing/vulkan/blend_response.h"

namespace lapwing {

PointCloud::PointCloud(std::shared_ptr<gpu::Context> context,
                       std::span<const Eigen::Vector3d> positions)
    : context_(std::move(context)),
      transfer_(*context_),
      origin_(bounds_of(positions).center()),
      buffer_(*context_, "points", positions.size() * sizeof(Vec4)) {
  place(positions);
}

void PointCloud::place(std::span<const Eigen::Vector3d> positions) {
  std::vector<Vec4> places;
  places.reserve(positions.size());
  for (const Eigen::Vector3d& position : positions) places.push_back(place_of(position, origin_));
  revision_.renew();
  transfer_.upload(buffer_, places);
}

}  // namespace lapwing
