#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "lapwing/mesh/mesh.h"

namespace lapwing {

using Vec4 = std::array<float, 4>;

/// Returns a vertex as the shaders store it: relative to `origin`, with w = 1.
inline Vec4 place_of(const Eigen::Vector3d& position, const Eigen::Vector3d& origin) {
  const Eigen::Vector3f place = (position - origin).cast<float>();
  return {place.x(), place.y(), place.z(), 1.0F};
}

/// Four columns of a blend with a parameter other than 0, in the layout of
/// shaders/blend_response.comp.
struct alignas(16) BlendGroup {
  Vec4 parameters;
  std::uint32_t number;  ///< index among all groups of columns, skipped ones included
};

/// The kernels of a drag frame on the CPU, in the memory and layouts of the shaders, in float32.
/// They are for software devices, on which the shaders take 2.5 to 7 times as long, a submission
/// included. The bits do not depend on the number of threads, and agree with the shaders within
/// float32 rounding.

/// Input of shaders/blend_response.comp for one range of vertices.
struct BlendRange {
  std::span<const Index> moving;
  std::span<const Vec4> rests;  ///< per vertex of `moving`; w is that of the positions
  std::span<const Vec4> basis;  ///< per group and axis one for each vertex of `moving`
};
void blend_on_host(const BlendRange& range, std::span<const BlendGroup> groups,
                   std::span<Vec4> positions);

/// Input of shaders/vertex_normals.comp, from build_fans (vulkan/vertex_normals.h). normals_on_host
/// sets the normals' w to 0.
struct FanLists {
  std::span<const Index> starts;
  std::span<const Index> corners;
};
void normals_on_host(std::span<const Index> which, const FanLists& fans,
                     std::span<const Vec4> positions, std::span<Vec4> normals);

}  // namespace lapwing
