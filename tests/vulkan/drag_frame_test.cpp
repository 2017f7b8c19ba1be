// Compares the frames of drags on the device with their CPU twin.
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kernels/twins.h"
#include "lapwing/deform/proxy_drag.h"
#include "lapwing/deform/turn_tracker.h"
#include "lapwing/gpu/command_list.h"
#include "lapwing/render/surface.h"
#include "lapwing/vulkan/vulkan_drag_frame.h"
#include "support/largest_distance.h"
#include "support/rippled_cylinder.h"

namespace lapwing {
namespace {

using Eigen::Affine3d;
using Eigen::AngleAxisd;
using Eigen::Vector3d;
using test::largest_distance;

HandleMotions turned(double degrees, const Vector3d& axis, const Vector3d& move) {
  return {{test::turn_and_move(degrees, axis, move)},
          {AngleAxisd(degrees * std::numbers::pi / 180.0, axis)}};
}

// The same drag on a device and on the CPU.
class TwinDrags {
 public:
  TwinDrags(VulkanKernels& kernels, const Mesh& mesh, EditRegion region)
      : mesh_(mesh),
        drag_(ProxyDrag::make(std::make_shared<const DeformSolver>(
            mesh.positions, mesh.topology(), std::move(region), DeformOptions{}, cpu_))),
        twin_(drag_->problem()),
        device_(kernels.make_drag_frame(drag_->problem())),
        context_(*kernels.context()),
        commands_(context_, "drag frame"),
        positions_(context_, "positions", 4 * sizeof(float) * mesh.vertex_count()) {
    const std::vector<Vector3d> start = drag_->begin({});
    twin_.begin(start);
    device_->begin(start);
  }

  void step(const HandleMotions& motions) {
    const DragFrameInput* const input = drag_->step(motions);
    ASSERT_NE(input, nullptr);
    twin_.step(*input);
    device_->set_input(*input);
    gpu::Recorder recorder(commands_);
    device_->record(recorder);
    device_->record_positions(recorder, origin_, positions_);
    recorder.finish();
    commands_.run();
  }

  // Returns the largest distance between the twins, relative to the diagonal.
  double difference() const {
    return largest_distance(device_->displacement(), twin_.displacement()) / diagonal();
  }
  double diagonal() const { return bounds_of(mesh_.positions).diagonal(); }
  const ProxyDrag& drag() const { return *drag_; }
  const CpuDragFrame& twin() const { return twin_; }

  // Returns the positions of the problem's vertices on the device.
  std::vector<Vector3d> shown() {
    std::vector<std::array<float, 4>> all(mesh_.vertex_count());
    gpu::Transfer(context_).download(positions_, all);
    std::vector<Vector3d> shown;
    for (const Index v : drag_->problem()->vertices) {
      shown.push_back(origin_ + Vector3d(all[v][0], all[v][1], all[v][2]));
    }
    return shown;
  }

 private:
  const Mesh& mesh_;
  const Vector3d origin_{0.5, -0.25, 3.0};
  CpuKernels cpu_;
  std::unique_ptr<ProxyDrag> drag_;
  CpuDragFrame twin_;
  std::unique_ptr<VulkanDragFrame> device_;
  gpu::Context& context_;
  gpu::CommandList commands_;
  gpu::Buffer positions_;
};

class DragFrames : public test::KernelTest {
 protected:
  VulkanKernels& device() { return static_cast<VulkanKernels&>(*kernels); }
  const Mesh cylinder_ = test::rippled_cylinder();
};

INSTANTIATE_TEST_SUITE_P(Twins, DragFrames, ::testing::ValuesIn(std::span(test::kTwins).subspan(1)),
                         [](const auto& test) { return std::string(test.param.name); });

TEST_P(DragFrames, AgreeWithTheirTwin) {
  EditRegion region = test::ends_of_cylinder(cylinder_);
  // Graded vertices are held by a stiffness.
  for (Index v = 0; v < cylinder_.vertex_count(); ++v) {
    const double z = cylinder_.positions[v].z();
    if (z > 5.0 && z <= 5.4) region.graded.push_back({v, 0, (z - 5.0) / 0.4});
  }
  TwinDrags drags(device(), cylinder_, region);
  for (int frame = 1; frame <= 12; ++frame) {
    drags.step(turned(4.0 * frame, Vector3d::UnitX(), {0.0, 0.03 * frame, 0.0}));
  }
  EXPECT_LT(drags.difference(), GetParam().precision == Precision::float64 ? 1e-11 : 1e-6);
  const std::vector<Vector3d> shown = drags.shown();
  double off = 0.0;
  for (std::size_t k = 0; k < shown.size(); ++k) {
    const Index v = drags.drag().problem()->vertices[k];
    off =
        std::max(off, (shown[k] - cylinder_.positions[v] - drags.twin().displacement()[k]).norm());
  }
  EXPECT_LT(off, 2e-6 * drags.diagonal());
}

// Counts the work of one frame of a drawn surface.
TEST(ADrawnDragFrame, IsOneSubmissionThatReturnsNothing) {
  LAPWING_NEEDS_GPU();
  gpu::ContextOptions options;
  options.profile = true;
  options.map_device_memory = false;
  const auto context = std::make_shared<gpu::Context>(options);
  VulkanKernels kernels(context, Precision::float32);
  const Mesh mesh = test::rippled_cylinder();
  CpuKernels cpu;
  const auto drag = ProxyDrag::make(std::make_shared<const DeformSolver>(
      mesh.positions, mesh.topology(), test::ends_of_cylinder(mesh), DeformOptions{}, cpu));
  const std::shared_ptr<VulkanDragFrame> frame = kernels.make_drag_frame(drag->problem());
  frame->begin(drag->begin({}));
  CpuDragFrame twin(drag->problem());
  twin.begin(drag->begin({}));
  Surface surface(context, mesh.positions, mesh.topology());
  for (int k = 1; k <= 3; ++k) {
    const DragFrameInput* const input =
        drag->step(turned(3.0 * k, Vector3d::UnitX(), Vector3d::Zero()));
    twin.step(*input);
    context->profile()->take();
    const gpu::TransferCounts before = context->transfers();
    surface.follow(frame, *input);
    surface.finish();
    if (k == 1) continue;  // the first frame also uploads the list of vertices
    const gpu::DeviceUse use = context->profile()->take();
    EXPECT_EQ(use.submissions, 1U);
    EXPECT_EQ(context->transfers().downloaded, before.downloaded);
    EXPECT_EQ(context->transfers().uploaded - before.uploaded,
              48 * drag->problem()->node_count + 12 * drag->problem()->stiffness.size());
    const std::map<std::string, std::uint64_t> expected{
        {"prolongate", 1}, {"fit_rotations", 8},     {"energy_gradient", 8},
        {"smooth", 8},     {"show_displacement", 1}, {"vertex_normals", 1}};
    ASSERT_EQ(use.kernels.size(), expected.size());
    for (const auto& [name, dispatches] : expected) {
      EXPECT_EQ(use.kernels.at(name).dispatches, dispatches) << name;
    }
  }
  const DragState pose = drag->pose(twin.displacement());
  Positions moved = mesh.positions;
  for (std::size_t v = 0; v < moved.size(); ++v) moved[v] += pose.displacement[v];
  EXPECT_LT(largest_distance(surface.positions(), moved),
            1e-5 * bounds_of(mesh.positions).diagonal());
  // The surface can then be placed and dragged by a response as before.
  surface.place(mesh.positions);
  EXPECT_LT(largest_distance(surface.positions(), mesh.positions), 1e-6);
}

// A frame that is not drawn is computed before the next one.
TEST(ADrawnDragFrame, IsNotSkipped) {
  LAPWING_NEEDS_GPU();
  const auto context = std::make_shared<gpu::Context>();
  VulkanKernels kernels(context, Precision::float32);
  const Mesh mesh = test::rippled_cylinder();
  CpuKernels cpu;
  const auto drag = ProxyDrag::make(std::make_shared<const DeformSolver>(
      mesh.positions, mesh.topology(), test::ends_of_cylinder(mesh), DeformOptions{}, cpu));
  Positions positions[2];
  for (const bool draws_each : {false, true}) {
    const std::shared_ptr<VulkanDragFrame> frame = kernels.make_drag_frame(drag->problem());
    frame->begin(drag->begin({}));
    Surface surface(context, mesh.positions, mesh.topology());
    for (int k = 1; k <= 3; ++k) {
      surface.follow(frame, *drag->step(turned(3.0 * k, Vector3d::UnitX(), Vector3d::Zero())));
      if (draws_each) surface.finish();
    }
    positions[draws_each ? 1 : 0] = surface.positions();
  }
  EXPECT_EQ(positions[0], positions[1]);
}

}  // namespace
}  // namespace lapwing
