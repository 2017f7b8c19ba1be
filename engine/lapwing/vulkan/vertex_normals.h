#pragma once

#include <span>
#include <vector>

#include "lapwing/gpu/recorder.h"
#include "lapwing/gpu/texel_buffer.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/vulkan/vulkan_state.h"

namespace lapwing {

/// The triangles around each vertex as fans: corners c0, c1, c2, ... stand for the triangles
/// (i, c0, c1), (i, c1, c2), ... A corner with kFanBegins set begins another fan. An interior
/// manifold vertex of k triangles has one fan of k + 1 corners, half of what listing each triangle
/// would read. Every triangle appears once, oriented as it was.
Adjacency build_fans(std::span<const Triangle> triangles, const Adjacency& vertex_triangles);
inline constexpr Index kFanBegins = 0x80000000U;

/// Kernel vertex_normals over one mesh: normals from positions, one vec4 per vertex each.
class VertexNormals {
 public:
  VertexNormals(VulkanState& state, const Topology& topology);

  /// The vertices `which` as `record` takes them.
  gpu::TexelBuffer upload_list(std::span<const Index> which) const;
  /// Records the normals of `which` into `normals`, whose w stays.
  void record(gpu::Recorder& recorder, const gpu::TexelBuffer& which,
              const gpu::TexelBuffer& positions, const gpu::Buffer& normals) const;

  /// Does now, on the processor, what the recorded commands would. Everything must be mapped.
  void run_on_host(const gpu::TexelBuffer& which, const gpu::TexelBuffer& positions,
                   const gpu::Buffer& normals) const;

 private:
  VertexNormals(VulkanState& state, const Adjacency& fans);

  VulkanState& state_;
  gpu::TexelBuffer fan_starts_;
  gpu::TexelBuffer fan_corners_;
};

}  // namespace lapwing
