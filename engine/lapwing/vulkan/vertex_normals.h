#pragma once

#include <span>

#include "lapwing/gpu/kernel.h"
#include "lapwing/gpu/recorder.h"
#include "lapwing/gpu/transfer.h"
#include "lapwing/mesh/split_normals.h"

namespace lapwing {

/// Returns the triangles around each vertex i as fans. Corners c0, c1, c2, ... stand for the
/// triangles (i, c0, c1), (i, c1, c2), ... A corner with kFanBegins set begins another fan. An
/// interior manifold vertex with k triangles has one fan of k + 1 corners. This needs half the
/// reads of a list of triangles. Every triangle appears once and keeps its orientation. A vertex
/// may have extra normals (SplitNormals). An entry with the normal's number and kNormalBegins set
/// precedes the fans of each extra normal.
Adjacency build_fans(std::span<const Triangle> triangles, const Adjacency& vertex_triangles,
                     const SplitNormals& split);
inline constexpr Index kFanBegins = 0x80000000U;
inline constexpr Index kNormalBegins = 0x40000000U;

/// Runs the kernel vertex_normals on one mesh. Position buffers have one vec4 per vertex. Normal
/// buffers have one vec4 per normal of SplitNormals.
class VertexNormals {
 public:
  VertexNormals(gpu::Context& context, gpu::Transfer& transfer, const Topology& topology,
                const SplitNormals& split);

  /// Records commands that compute all normals of the vertices `which`. The commands write only x,
  /// y and z of `normals`.
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
