#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "lapwing/mesh/mesh.h"

namespace lapwing {

using Vec4 = std::array<float, 4>;

/// Returns a position in the format of the shaders: relative to `origin`, with w = 1.
inline Vec4 place_of(const Eigen::Vector3d& position, const Eigen::Vector3d& origin) {
  const Eigen::Vector3f place = (position - origin).cast<float>();
  return {place.x(), place.y(), place.z(), 1.0F};
}

/// A group of four columns of a blend, at least one with a parameter other than 0, in the layout of
/// shaders/blend_response.comp.
struct alignas(16) BlendGroup {
  Vec4 parameters;
  std::uint32_t number;  ///< index among all groups of columns, including skipped groups
};

/// The kernels of a drag frame on the CPU, in float32, on the buffers and layouts of the shaders.
/// They are used for software devices, on which the shaders take 2.5 to 7 times as long (including
/// the submission). Results do not depend on the number of threads, and agree with those of the
/// shaders within float32 rounding.

/// Input of shaders/blend_response.comp for one range of vertices.
struct BlendRange {
  std::span<const Index> moving;
  std::span<const Vec4> rests;  ///< per vertex of `moving`; w is copied to the positions
  std::span<const Vec4> basis;  ///< for each group and axis, one entry per vertex of `moving`
};
void blend_on_host(const BlendRange& range, std::span<const BlendGroup> groups,
                   std::span<Vec4> positions);

/// Input of shaders/vertex_normals.comp, computed by build_fans (vulkan/vertex_normals.h).
/// normals_on_host sets w of the normals to 0.
struct FanLists {
  std::span<const Index> starts;
  std::span<const Index> corners;
};
void normals_on_host(std::span<const Index> which, const FanLists& fans,
                     std::span<const Vec4> positions, std::span<Vec4> normals);

}  // namespace lapwing
