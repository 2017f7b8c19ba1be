#include "lapwing/render/surface.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "lapwing/base/stopwatch.h"
#include "lapwing/vulkan/vulkan_drag_frame.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

std::vector<Vec4> places_of(std::span<const Vector3d> positions, const Vector3d& origin) {
  std::vector<Vec4> places;
  places.reserve(positions.size());
  for (const Vector3d& position : positions) places.push_back(place_of(position, origin));
  return places;
}

std::vector<Vector3d> download_vectors(gpu::Transfer& transfer, const gpu::Buffer& buffer,
                                       const Vector3d& offset) {
  std::vector<Vec4> values(buffer.bytes() / sizeof(Vec4));
  transfer.download(buffer, values);
  std::vector<Vector3d> vectors;
  vectors.reserve(values.size());
  for (const Vec4& v : values) vectors.emplace_back(Vector3d(v[0], v[1], v[2]) + offset);
  return vectors;
}

}  // namespace

Surface::Surface(std::shared_ptr<gpu::Context> context, std::span<const Vector3d> positions,
                 const Topology& topology, double feature_angle_degrees)
    : Surface(std::move(context), positions, topology,
              split_normals(positions, topology, feature_angle_degrees)) {}

Surface::Surface(std::shared_ptr<gpu::Context> context, std::span<const Vector3d> positions,
                 const Topology& topology, SplitNormals split)
    : context_(std::move(context)),
      topology_(topology),
      transfer_(*context_),
      blend_(BlendResponse::kernel(*context_)),
      commands_(*context_, "surface"),
      origin_(bounds_of(surface_positions(positions, topology)).center()),
      positions_(*context_, "positions", positions.size() * sizeof(Vec4)),
      normals_(*context_, "normals",
               (positions.size() + split.extra_vertices.size()) * sizeof(Vec4)),
      triangles_(*context_, "triangles", topology.triangles.size() * sizeof(Triangle)),
      vertex_normals_(*context_, transfer_, topology, split),
      on_host_(context_->description().type == "software" && !normals_.mapped().empty()),
      known_(places_of(positions, origin_)) {
  transfer_.upload(positions_, known_);
  transfer_.upload(triangles_, topology.triangles);
  if (!split.extra_vertices.empty()) {
    corner_normals_.emplace(*context_, "corner normals", split.of_corner.size() * sizeof(Index));
    transfer_.upload(*corner_normals_, split.of_corner);
    if (on_host_) normal_of_corner_ = std::move(split.of_corner);
  }
  make_normals();
}

void Surface::make_normals() {
  std::vector<Index> all(vertex_count());
  std::iota(all.begin(), all.end(), 0U);
  if (on_host_) return vertex_normals_.run_on_host(all, positions_, normals_);
  const gpu::Buffer list(*context_, "all vertices", all.size() * sizeof(Index));
  transfer_.upload(list, all);
  gpu::Recorder recorder(commands_);
  recorder.fill(normals_, 0);
  vertex_normals_.record(recorder, list, positions_, normals_);
  recorder.finish();
  commands_.run();
}

const DrawOrder* Surface::draw_order() const {
  // The largest index is 3 * triangle_count() - 1, the last corner.
  const bool fits =
      3 * std::uint64_t{triangle_count()} <= context_->limits().maxDrawIndexedIndexValue;
  if (!on_host_ || !fits) return nullptr;
  if (!order_) {
    order_.emplace(*context_, positions_.mapped_as<Vec4>(), topology_.triangles, normal_of_corner_);
  }
  return &*order_;
}

void Surface::place(std::span<const Vector3d> positions) {
  move_to(positions, [](Index) { return true; });
}

template <typename Wanted>
void Surface::move_to(std::span<const Vector3d> positions, const Wanted& wanted) {
  std::vector<Index> elsewhere;
  for (Index v = 0; v < vertex_count(); ++v) {
    if (wanted(v) && known_[v] != place_of(positions[v], origin_)) elsewhere.push_back(v);
  }
  if (elsewhere.empty()) return;
  // Move these vertices by a response without columns that starts from their new positions.
  const auto moved = std::make_shared<BlendResponse>(
      context_, transfer_, ResponseColumns{.moving = elsewhere, .numbers = {}}, topology_);
  moved->set_rest(transfer_, positions, {}, origin_);
  blend(moved, {});
  for (const Index v : elsewhere) known_[v] = place_of(positions[v], origin_);
}

void Surface::begin(BlendResponse& response, std::span<const Vector3d> rest,
                    std::span<const Vector3d> displacement) {
  // If this response moved the surface last, no other vertex has moved since.
  if (moved_by_.get() != &response) {
    const std::span<const Index> moving = response.moving();
    auto next = moving.begin();
    move_to(rest, [&](Index v) {
      const bool moves = next != moving.end() && *next == v;
      if (moves) ++next;
      return !moves;
    });
  }
  context_->wait_for_submitted();
  response.set_rest(transfer_, rest, displacement, origin_);
}

void Surface::blend(const std::shared_ptr<BlendResponse>& response,
                    std::span<const double> parameters) {
  revision_.renew();
  if (response != moved_by_) {
    finish();
    context_->wait_for_submitted();
    moved_by_ = response;
    frame_.reset();
    for (const Index v : response->moving()) known_[v][0] = kUnknown;
  }
  response->set_parameters(parameters);
  is_pending_ = !on_host_;
  if (!on_host_) return;
  // The last draw may still read the buffers.
  context_->wait_for_submitted();
  Stopwatch watch;
  response->run_on_host(positions_.mapped_as<Vec4>());
  times_.blend_ms += watch.elapsed_ms();
  watch.restart();
  vertex_normals_.run_on_host(response->affected().mapped_as<Index>(), positions_, normals_);
  times_.normals_ms += watch.elapsed_ms();
}

void Surface::follow(const std::shared_ptr<VulkanDragFrame>& frame, const DragFrameInput& input) {
  revision_.renew();
  // Each frame starts from the last one, so none may be skipped.
  finish();
  if (frame != frame_) {
    context_->wait_for_submitted();
    const std::vector<Index>& vertices = frame->problem()->vertices;
    for (const Index v : vertices) known_[v][0] = kUnknown;
    VertexSet moving(vertices.begin(), vertices.end());
    std::ranges::sort(moving);
    const std::vector<Index> around = with_ring_neighbours(moving, topology_.rings);
    around_frame_.emplace(*context_, "vertices around a drag", around.size() * sizeof(Index));
    transfer_.upload(*around_frame_, around);
    moved_by_.reset();
    frame_ = frame;
  }
  frame_->set_input(input);
  is_pending_ = true;
}

void Surface::record_blend(gpu::Recorder& recorder) const {
  if (!is_pending_) return;
  if (frame_ != nullptr) {
    frame_->record(recorder);
    frame_->record_positions(recorder, origin_, positions_);
  } else {
    moved_by_->record(recorder, blend_, positions_);
  }
}

bool Surface::record_normals(gpu::Recorder& recorder) {
  if (!std::exchange(is_pending_, false)) return false;
  const gpu::Buffer& affected = frame_ != nullptr ? *around_frame_ : moved_by_->affected();
  vertex_normals_.record(recorder, affected, positions_, normals_);
  constexpr VkPipelineStageFlags2 kDrawing = VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT;
  recorder.access(positions_, kDrawing, VK_ACCESS_2_SHADER_STORAGE_READ_BIT);
  recorder.access(normals_, kDrawing, VK_ACCESS_2_SHADER_STORAGE_READ_BIT);
  return true;
}

void Surface::finish() {
  if (!is_pending_) return;
  gpu::Recorder recorder(commands_);
  record_blend(recorder);
  record_normals(recorder);
  recorder.finish();
  commands_.run();
}

SurfaceTimes Surface::take_times() {
  return std::exchange(times_, {});
}

Positions Surface::positions() {
  finish();
  return download_vectors(transfer_, positions_, origin_);
}

std::vector<Vector3d> Surface::normals() {
  finish();
  return download_vectors(transfer_, normals_, Vector3d::Zero());
}

}  // namespace lapwing
