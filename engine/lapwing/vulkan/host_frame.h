#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "lapwing/mesh/mesh.h"

namespace lapwing {

using Vec4 = std::array<float, 4>;

/// A vertex among the positions of a surface: relative to `origin`, and 1.
inline Vec4 place_of(const Eigen::Vector3d& position, const Eigen::Vector3d& origin) {
  const Eigen::Vector3f place = (position - origin).cast<float>();
  return {place.x(), place.y(), place.z(), 1.0F};
}

/// Four columns of a blend with a parameter other than 0, as shaders/blend_response.comp reads
/// them.
struct alignas(16) BlendGroup {
  Vec4 parameters;
  std::uint32_t number;  ///< of the group among all
};

/// The kernels of a drag frame, run by the processor on the very memory that the shaders would read
/// and write, in float32 and in the shaders' layouts. For devices that are the processor in
/// disguise: what Mesa's compiler makes of the shaders takes 2.5 to 7 times as long, a submission
/// included. Same bits for any number of threads; within float32 rounding of what the shaders give.

/// shaders/blend_response.comp over one range of vertices.
struct BlendRange {
  std::span<const Index> moving;
  std::span<const Vec4> rests;  ///< per vertex of `moving`; w is that of the positions
  std::span<const Vec4> basis;  ///< per group and axis one for each vertex of `moving`
};
void blend_on_host(const BlendRange& range, std::span<const BlendGroup> groups,
                   std::span<Vec4> positions);

/// shaders/vertex_normals.comp; `starts` and `corners` are build_fans' (vulkan/vertex_normals.h).
/// The normals' w becomes 0.
struct FanLists {
  std::span<const Index> starts;
  std::span<const Index> corners;
};
void normals_on_host(std::span<const Index> which, const FanLists& fans,
                     std::span<const Vec4> positions, std::span<Vec4> normals);

}  // namespace lapwing
