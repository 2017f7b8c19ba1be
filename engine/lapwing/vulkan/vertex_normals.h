#pragma once

#include <span>

#include "lapwing/gpu/kernel.h"
#include "lapwing/gpu/recorder.h"
#include "lapwing/gpu/transfer.h"
#include "lapwing/mesh/topology.h"

namespace lapwing {

/// Returns the triangles around each vertex i as fans. Corners c0, c1, c2, ... stand for the
/// triangles (i, c0, c1), (i, c1, c2), ... A corner with kFanBegins set begins another fan. An
/// interior manifold vertex of k triangles has one fan of k + 1 corners, half the reads of a list
/// of triangles. Every triangle appears once, in its orientation.
Adjacency build_fans(std::span<const Triangle> triangles, const Adjacency& vertex_triangles);
inline constexpr Index kFanBegins = 0x80000000U;

/// Kernel vertex_normals over one mesh. Positions and normals have one vec4 per vertex.
class VertexNormals {
 public:
  VertexNormals(gpu::Context& context, gpu::Transfer& transfer, const Topology& topology);

  /// Records the normals of the vertices `which` into `normals`, and leaves their w unchanged.
  void record(gpu::Recorder& recorder, const gpu::Buffer& which, const gpu::Buffer& positions,
              const gpu::Buffer& normals) const;
  /// Does the same as the recorded commands, at once on the CPU. All buffers must be mapped.
  void run_on_host(std::span<const Index> which, const gpu::Buffer& positions,
                   const gpu::Buffer& normals) const;

 private:
  VertexNormals(gpu::Context& context, gpu::Transfer& transfer, const Adjacency& fans);

  gpu::Kernel kernel_;
  gpu::Buffer fan_starts_;
  gpu::Buffer fan_corners_;
};

}  // namespace lapwing
