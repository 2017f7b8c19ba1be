#pragma once

#include <span>

#include "lapwing/gpu/kernel.h"
#include "lapwing/gpu/recorder.h"
#include "lapwing/gpu/transfer.h"
#include "lapwing/mesh/split_normals.h"

namespace lapwing {

/// Returns the triangles around each vertex i as fans. Corners c0, c1, c2, ... represent the
/// triangles (i, c0, c1), (i, c1, c2), ... A corner with kFanBegins set begins a new fan. An
/// interior manifold vertex with k triangles has one fan of k + 1 corners. This needs half the
/// reads of a list of triangles. Every triangle appears once and keeps its orientation. A vertex
/// may have additional normals (SplitNormals). The fans of each additional normal follow an entry
/// that contains the normal's index and kNormalBegins.
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
  /// Does the work of the recorded commands immediately, on the CPU. All buffers must be mapped.
  void run_on_host(std::span<const Index> which, const gpu::Buffer& positions,
                   const gpu::Buffer& normals) const;

 private:
  VertexNormals(gpu::Context& context, gpu::Transfer& transfer, const Adjacency& fans);

  gpu::Kernel kernel_;
  gpu::Buffer fan_starts_;
  gpu::Buffer fan_corners_;
};

}  // namespace lapwing
