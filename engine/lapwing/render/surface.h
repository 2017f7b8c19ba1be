#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "lapwing/gpu/buffer.h"
#include "lapwing/gpu/command_list.h"
#include "lapwing/gpu/kernel.h"
#include "lapwing/gpu/recorder.h"
#include "lapwing/gpu/transfer.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/render/draw_order.h"
#include "lapwing/render/revision.h"
#include "lapwing/vulkan/blend_response.h"
#include "lapwing/vulkan/vertex_normals.h"

namespace lapwing {

/// Time in milliseconds.
struct SurfaceTimes {
  double blend_ms = 0.0;
  double normals_ms = 0.0;
};

/// A mesh in device memory, in float32, from which it is drawn without a copy. Construction uploads
/// it once; after that only what moves is. The kernels that move it are recorded into the commands
/// that draw it (`record`). On a software device the processor does at once, in the same memory,
/// what they would (vulkan/host_frame.h), unless that memory is not mapped.
///
/// The device must be done with what was drawn last whenever the surface is moved. Not for use from
/// several threads at once.
class Surface {
 public:
  /// `topology` must outlive it.
  Surface(std::shared_ptr<gpu::Context> context, std::span<const Eigen::Vector3d> positions,
          const Topology& topology);

  /// Puts the vertices where `positions`, of the whole mesh, says. Uploads those that are not
  /// there.
  void place(std::span<const Eigen::Vector3d> positions);

  /// Lets blends of `response` begin from `rest` + `displacement`, both of the whole mesh; no
  /// displacement is none. Uploads the vertices that it moves, and of the others those that are not
  /// at rest.
  void begin(BlendResponse& response, std::span<const Eigen::Vector3d> rest,
             std::span<const Eigen::Vector3d> displacement = {});
  /// One drag frame: the vertices that `response` moves, then the normals of those and of their
  /// neighbours. One number per column. Allocates nothing. After `begin`.
  void blend(const std::shared_ptr<BlendResponse>& response, std::span<const double> parameters);

  /// Records what is left to do of the last `place` or `blend`: first the one, then the other,
  /// which says whether there was something. Before a rendering scope.
  void record_blend(gpu::Recorder& recorder) const;
  bool record_normals(gpu::Recorder& recorder);
  /// Does it now and waits, for whoever reads or draws the surface on commands of its own.
  void finish();
  /// Of what the processor did since this was last called.
  SurfaceTimes take_times();

  /// What the device holds, in mesh coordinates, and its unit normals, zero where a vertex has no
  /// triangle with area. For tests.
  Positions positions();
  std::vector<Eigen::Vector3d> normals();

  /// Another number whenever something moved.
  std::uint64_t revision() const { return revision_.number(); }

  gpu::Context& context() const { return *context_; }
  std::size_t vertex_count() const { return known_.size(); }
  std::size_t triangle_count() const { return triangles_.bytes() / sizeof(Triangle); }
  /// What was subtracted from the positions: the centre of the bounding box at construction.
  /// Float32 positions then keep their digits wherever the mesh lies.
  const Eigen::Vector3d& origin() const { return origin_; }
  /// One vec4 per vertex: the position relative to `origin()`, and 1.
  const gpu::Buffer& position_buffer() const { return positions_; }
  /// One vec4 per vertex: the unit normal, or zero, and 0.
  const gpu::Buffer& normal_buffer() const { return normals_; }
  /// Three uint per triangle.
  const gpu::Buffer& triangle_buffer() const { return triangles_; }
  /// How a software device draws it soonest where it is now; null where the device moves it itself.
  /// Takes O(n log n) at the first call, linear time at the first after it moved.
  const DrawOrder* draw_order() const;

 private:
  void make_normals();
  template <typename Wanted>
  void move_to(std::span<const Eigen::Vector3d> positions, const Wanted& wanted);

  std::shared_ptr<gpu::Context> context_;
  const Topology& topology_;
  gpu::Transfer transfer_;
  gpu::Kernel blend_;
  gpu::CommandList commands_;
  Eigen::Vector3d origin_;
  gpu::Buffer positions_;
  gpu::Buffer normals_;
  gpu::Buffer triangles_;
  VertexNormals vertex_normals_;
  bool on_host_;
  mutable std::optional<DrawOrder> order_;  ///< once it was asked for
  mutable bool is_order_old_ = true;        ///< whether the surface has moved since
  /// Where the device has each vertex; not a number where it alone knows.
  std::vector<Vec4> known_;
  std::shared_ptr<BlendResponse> moved_by_;  ///< last; what was recorded of it may still run
  bool is_pending_ = false;                  ///< whether it is still to be recorded
  SurfaceTimes times_;
  Revision revision_;
};

}  // namespace lapwing
