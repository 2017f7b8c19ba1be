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
#include "lapwing/mesh/split_normals.h"
#include "lapwing/render/draw_order.h"
#include "lapwing/render/revision.h"
#include "lapwing/vulkan/blend_response.h"
#include "lapwing/vulkan/vertex_normals.h"

namespace lapwing {

class VulkanDragFrame;
struct DragFrameInput;

struct SurfaceTimes {
  double blend_ms = 0.0;
  double normals_ms = 0.0;
};

/// A mesh in device memory, in float32, which is drawn without a copy. Construction uploads the
/// whole mesh; later calls upload only moved vertices. The kernels that move the mesh are recorded
/// into the commands that draw it (`record_blend`, `record_normals`). On a software device with
/// mapped memory, the CPU does their work immediately (vulkan/host_frame.h).
///
/// The device must have finished the last draw before the surface is moved. Not thread-safe.
class Surface {
 public:
  /// `topology` must outlive the surface. An edge is hard if the normals of its faces at these
  /// `positions` differ by more than the feature angle. Hard edges remain hard when the surface
  /// moves.
  Surface(std::shared_ptr<gpu::Context> context, std::span<const Eigen::Vector3d> positions,
          const Topology& topology, double feature_angle_degrees = kFeatureAngleDegrees);

  /// Moves the vertices to `positions`, one for each vertex of the mesh. Uploads only the positions
  /// that differ.
  void place(std::span<const Eigen::Vector3d> positions);

  /// Makes blends of `response` start from `rest` + `displacement`. Both have one entry per vertex;
  /// an empty displacement means zero. Uploads the start positions of the vertices that the
  /// response moves, and moves all others back to `rest`.
  void begin(BlendResponse& response, std::span<const Eigen::Vector3d> rest,
             std::span<const Eigen::Vector3d> displacement = {});
  /// Computes one drag frame: the positions of the vertices that `response` moves, then the normals
  /// of these and their neighbours. `parameters` has one number per response column. Does not
  /// allocate. Call `begin` first.
  void blend(const std::shared_ptr<BlendResponse>& response, std::span<const double> parameters);

  /// Computes one frame of a settled drag: the positions of the vertices of `frame`, then their
  /// normals. Shaders compute it on every device. Uploads only `input`. Call `place` before the
  /// first frame of a drag, so that all other vertices are in position.
  void follow(const std::shared_ptr<VulkanDragFrame>& frame, const DragFrameInput& input);

  /// Record the pending work of the last `place`, `blend` or `follow`. Call both functions before a
  /// rendering scope, `record_blend` first. `record_normals` returns whether there was any work.
  void record_blend(gpu::Recorder& recorder) const;
  bool record_normals(gpu::Recorder& recorder);
  /// Runs the pending work and waits for it, for callers that use the surface in separate commands.
  void finish();
  /// Returns the times of the work on the CPU since the last call.
  SurfaceTimes take_times();

  /// Return the positions on the device in mesh coordinates, and the unit normals in the order of
  /// SplitNormals. A normal is zero if all its triangles have zero area. For tests.
  Positions positions();
  std::vector<Eigen::Vector3d> normals();

  /// Returns a number that changes whenever vertices move.
  std::uint64_t revision() const { return revision_.number(); }

  gpu::Context& context() const { return *context_; }
  std::size_t vertex_count() const { return known_.size(); }
  std::size_t triangle_count() const { return triangles_.bytes() / sizeof(Triangle); }
  /// Returns the offset that is subtracted from the positions: the centre of the surface's bounding
  /// box at construction. This preserves the precision of float32 positions if the mesh is far from
  /// the world's origin.
  const Eigen::Vector3d& origin() const { return origin_; }
  /// One vec4 per vertex: the position relative to `origin()`, and 1.
  const gpu::Buffer& position_buffer() const { return positions_; }
  /// One vec4 per normal of SplitNormals: the unit normal (or zero), and 0.
  const gpu::Buffer& normal_buffer() const { return normals_; }
  /// One uint per corner: the index of its normal, as in SplitNormals::of_corner.
  const gpu::Buffer& corner_normal_buffer() const {
    return corner_normals_ ? *corner_normals_ : triangles_;
  }
  /// Three uint per triangle.
  const gpu::Buffer& triangle_buffer() const { return triangles_; }
  /// Returns the order in which a software device draws the surface fastest. Returns null if
  /// shaders move the surface or if the device cannot index so many corners. The first call takes
  /// O(n log n).
  const DrawOrder* draw_order() const;

 private:
  Surface(std::shared_ptr<gpu::Context> context, std::span<const Eigen::Vector3d> positions,
          const Topology& topology, SplitNormals split);
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
  /// Empty if no normal is split. In this case, each corner has the normal of its vertex, and
  /// `triangles_` is used instead.
  std::optional<gpu::Buffer> corner_normals_;
  VertexNormals vertex_normals_;
  bool on_host_;
  std::vector<Index> normal_of_corner_;     ///< used by DrawOrder; empty if no normal is split
  mutable std::optional<DrawOrder> order_;  ///< set by the first draw_order()
  /// Positions on the device as far as the CPU knows them; NaN for the others.
  std::vector<Vec4> known_;
  std::shared_ptr<BlendResponse> moved_by_;  ///< last response; the device may still run its work
  std::shared_ptr<VulkanDragFrame> frame_;   ///< replaces `moved_by_` after `follow`
  /// The vertices of `frame_` and their neighbours, whose normals change.
  std::optional<gpu::Buffer> around_frame_;
  /// Whether the work of `moved_by_` or `frame_` must still be recorded.
  bool is_pending_ = false;
  SurfaceTimes times_;
  Revision revision_;
};

}  // namespace lapwing
