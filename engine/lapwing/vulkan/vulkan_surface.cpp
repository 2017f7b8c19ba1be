#include "lapwing/vulkan/vulkan_surface.h"

#include <numeric>
#include <utility>

#include "lapwing/base/stopwatch.h"
#include "lapwing/gpu/recorder.h"
#include "lapwing/vulkan/blend_response.h"
#include "lapwing/vulkan/vertex_normals.h"
#include "lapwing/vulkan/vulkan_state.h"

namespace lapwing {
namespace {

// Timestamps of `frame_` and of `normals_`.
enum FrameMoment : std::uint32_t { kBegun, kBlended, kNormalsDone, kFrameMoments };
enum NormalsMoment : std::uint32_t { kPlaced, kRenewed, kNormalsMoments };

std::vector<Eigen::Vector3d> download_vectors(VulkanState& state, const gpu::Buffer& buffer,
                                              const Eigen::Vector3d& offset) {
  std::vector<Vec4> values(buffer.bytes() / sizeof(Vec4));
  state.transfer.download(buffer, std::span<Vec4>(values));
  std::vector<Eigen::Vector3d> vectors;
  vectors.reserve(values.size());
  for (const Vec4& v : values) vectors.emplace_back(Eigen::Vector3d(v[0], v[1], v[2]) + offset);
  return vectors;
}

}  // namespace

struct VulkanSurface::Buffers {
  Buffers(VulkanState& state, const SurfaceInput& input, const Eigen::Vector3d& origin)
      : positions(*state.context, "positions", gpu::TexelBuffer::Format::vec4, input.rest.size()),
        normals(*state.context, "normals", input.rest.size() * sizeof(Vec4)),
        triangles(*state.context, "triangles", input.topology.triangles.size() * sizeof(Triangle)),
        blend_response(state, input, origin),
        vertex_normals(state, input.topology),
        affected(
            vertex_normals.upload_list(with_ring_neighbours(input.moving, input.topology.rings))) {}

  gpu::TexelBuffer positions;
  gpu::Buffer normals;
  gpu::Buffer triangles;
  BlendResponse blend_response;
  VertexNormals vertex_normals;
  gpu::TexelBuffer affected;  // the vertices whose normals a drag frame renews
};

VulkanSurface::VulkanSurface(std::shared_ptr<VulkanState> state, const SurfaceInput& input)
    : state_(std::move(state)),
      vertex_count_(input.rest.size()),
      triangle_count_(input.topology.triangles.size()),
      origin_(bounds_of(input.rest).center()),
      buffers_(std::make_unique<Buffers>(*state_, input, origin_)),
      on_host_(!state_->frames && !buffers_->normals.mapped().empty()) {
  upload_rest(input);
  if (on_host_) return;
  record_frame();
  record_normals();
}

VulkanSurface::~VulkanSurface() = default;

void VulkanSurface::upload_positions(std::span<const Eigen::Vector3d> positions) {
  std::vector<Vec4> places;
  places.reserve(vertex_count_);
  for (const Eigen::Vector3d& position : positions) {
    const Eigen::Vector3f place = (position - origin_).cast<float>();
    places.push_back({place.x(), place.y(), place.z(), 1.0F});
  }
  state_->transfer.upload(buffers_->positions.buffer(), std::span<const Vec4>(places));
}

void VulkanSurface::upload_rest(const SurfaceInput& input) {
  upload_positions(input.rest);
  state_->transfer.upload(buffers_->triangles, std::span<const Triangle>(input.topology.triangles));

  std::vector<Index> all(vertex_count_);
  std::iota(all.begin(), all.end(), 0U);
  const gpu::TexelBuffer everything = buffers_->vertex_normals.upload_list(all);
  if (on_host_) {
    buffers_->vertex_normals.run_on_host(everything, buffers_->positions, buffers_->normals);
    return;
  }
  gpu::CommandList rest_normals(*state_->context, "rest normals");
  gpu::Recorder recorder(rest_normals);
  recorder.fill(buffers_->normals, 0);
  buffers_->vertex_normals.record(recorder, everything, buffers_->positions, buffers_->normals);
  recorder.finish();
  rest_normals.run();
}

void VulkanSurface::record_frame() {
  frame_ = std::make_unique<gpu::CommandList>(*state_->context, "drag frame", kFrameMoments);
  gpu::Recorder recorder(*frame_);
  recorder.timestamp();
  buffers_->blend_response.record(recorder, buffers_->positions.buffer());
  recorder.timestamp();
  buffers_->vertex_normals.record(recorder, buffers_->affected, buffers_->positions,
                                  buffers_->normals);
  recorder.timestamp();
  recorder.finish();
}

void VulkanSurface::record_normals() {
  normals_ = std::make_unique<gpu::CommandList>(*state_->context, "normals", kNormalsMoments);
  gpu::Recorder recorder(*normals_);
  recorder.timestamp();
  buffers_->vertex_normals.record(recorder, buffers_->affected, buffers_->positions,
                                  buffers_->normals);
  recorder.timestamp();
  recorder.finish();
}

void VulkanSurface::set_basis(std::span<const double> basis) {
  buffers_->blend_response.set_basis(basis);
}

void VulkanSurface::set_axis_basis(std::span<const double> numbers) {
  buffers_->blend_response.set_axis_basis(numbers);
}

void VulkanSurface::set_rest(std::span<const Eigen::Vector3d> positions) {
  state_->context->wait_for_submitted();
  buffers_->blend_response.set_rest(positions);
}

void VulkanSurface::blend(std::span<const double> parameters) {
  buffers_->blend_response.set_parameters(parameters);
  if (on_host_) {
    // What was drawn last may still be read.
    state_->context->wait_for_submitted();
    const Stopwatch watch;
    buffers_->blend_response.run_on_host(buffers_->positions.buffer().mapped_as<Vec4>());
    times_.blend_ms += watch.elapsed_ms();
    renew_normals();
    return;
  }
  frame_->run();
  times_.blend_ms += frame_->milliseconds_between(kBegun, kBlended);
  times_.normals_ms += frame_->milliseconds_between(kBlended, kNormalsDone);
}

void VulkanSurface::place(std::span<const Eigen::Vector3d> positions) {
  state_->context->wait_for_submitted();
  upload_positions(positions);
  renew_normals();
}

void VulkanSurface::renew_normals() {
  if (on_host_) {
    const Stopwatch watch;
    buffers_->vertex_normals.run_on_host(buffers_->affected, buffers_->positions,
                                         buffers_->normals);
    times_.normals_ms += watch.elapsed_ms();
    return;
  }
  normals_->run();
  times_.normals_ms += normals_->milliseconds_between(kPlaced, kRenewed);
}

SurfaceTimes VulkanSurface::take_times() {
  return std::exchange(times_, {});
}

Positions VulkanSurface::positions() const {
  return download_vectors(*state_, buffers_->positions.buffer(), origin_);
}

std::vector<Eigen::Vector3d> VulkanSurface::normals() const {
  return download_vectors(*state_, buffers_->normals, Eigen::Vector3d::Zero());
}

gpu::Context& VulkanSurface::context() const {
  return *state_->context;
}
const gpu::Buffer& VulkanSurface::position_buffer() const {
  return buffers_->positions.buffer();
}
const gpu::Buffer& VulkanSurface::normal_buffer() const {
  return buffers_->normals;
}
const gpu::Buffer& VulkanSurface::triangle_buffer() const {
  return buffers_->triangles;
}

}  // namespace lapwing
