#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "lapwing/base/errors.h"
#include "lapwing/deform/deform_request.h"
#include "lapwing/deform/drag_session.h"
#include "lapwing/deform/handle_motion.h"
#include "lapwing/deform/proxy_drag.h"
#include "lapwing/deform/turn_tracker.h"
#include "lapwing/gpu/command_list.h"
#include "lapwing/gpu/recorder.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/mesh/subdivide.h"
#include "lapwing/vulkan/vulkan_drag_frame.h"
#include "lapwing/vulkan/vulkan_kernels.h"
#include "report/report.h"
#include "run/bench_device.h"
#include "run/subject.h"
#include "studies/ends_motion.h"
#include "studies/studies.h"

namespace lapwing::bench {
namespace {

using Eigen::Affine3d;
using Eigen::AngleAxisd;
using Eigen::Vector3d;

// A drag takes half a second. Then the hand rests.
constexpr int kFrames = 30;
constexpr std::chrono::microseconds kFrameInterval{1'000'000 / 60};
constexpr double kRest_ms = 500.0;
// The benchmark waits this long before a drag, so that background work can end.
constexpr std::chrono::milliseconds kBeforeDrag{1000};
constexpr double kLongestRest_ms = 10'000.0;
// Time of a frame while the hand rests, as in the viewer.
constexpr double kRestFrame_ms = 50.0;
constexpr int kFramesPerCheck = 5;

// The share of the motion in frame k.
double share_of(int k) {
  return 0.5 - 0.5 * std::cos(std::numbers::pi * k / kFrames);
}

class FollowedEdit {
 public:
  FollowedEdit(const Mesh& mesh, EndsMotion motion)
      : mesh_(mesh),
        ends_(moved_ends(motion, mesh.positions)),
        region_(held_region(ends_, mesh.positions, mesh.topology()).region),
        centroid_(handle_frame(region_.handles[0], mesh.positions).centroid),
        diagonal_(bounds_of(mesh.positions).diagonal()),
        solver_(std::make_shared<const DeformSolver>(mesh.positions, mesh.topology(), region_,
                                                     DeformParameters{}, kernels_)) {}

  Affine3d part(double share) const {
    return partial_motion(ends_.map, shortest_turn(ends_.map), centroid_, share);
  }
  // Returns the linear response.
  Positions linear(double share) const {
    if (response_ == nullptr) response_ = solver_->response();
    Positions positions = mesh_.positions;
    Drag(response_).move(std::array{part(share)}, positions);
    return positions;
  }
  // Returns the distance from a pose to where it settles, in percent of the diagonal.
  double off_percent(double share, const DragState& pose, Positions* settled = nullptr) const {
    DragState start = pose;
    start.last_result = {};
    DragSession& other = reference();
    other.begin(std::move(start));
    const DragState& end = other.state();
    const std::array motions{part(share)};
    for (int k = 0; k < kMostFrames && !end.last_result.settled && !end.last_result.exhausted;
         ++k) {
      other.step(motions);
    }
    if (settled != nullptr) *settled = displaced(end);
    return distance_percent(displaced(end), displaced(pose));
  }
  double distance_percent(const Positions& a, const Positions& b) const {
    double most = 0.0;
    for (std::size_t v = 0; v < a.size(); ++v) most = std::max(most, (a[v] - b[v]).norm());
    return 100.0 * most / diagonal_;
  }
  const std::shared_ptr<const DeformSolver>& solver() const { return solver_; }

 private:
  static constexpr int kMostFrames = 5;  // of 200 iterations each

  Positions displaced(const DragState& pose) const {
    Positions positions = mesh_.positions;
    for (std::size_t v = 0; v < positions.size(); ++v) positions[v] += pose.displacement[v];
    return positions;
  }
  // A separate session, so that checks do not change the history of the measured one.
  DragSession& reference() const {
    if (reference_ == nullptr) {
      reference_ = std::make_unique<DragSession>(std::make_shared<const DeformSolver>(
          mesh_.positions, mesh_.topology(), region_, DeformParameters{}, kernels_));
    }
    return *reference_;
  }

  const Mesh& mesh_;
  MovedEnds ends_;
  EditRegion region_;
  Vector3d centroid_;
  double diagonal_;
  mutable CpuKernels kernels_;
  std::shared_ptr<const DeformSolver> solver_;
  mutable std::shared_ptr<const DragResponse> response_;
  mutable std::unique_ptr<DragSession> reference_;
};

// Drags the handle of an edit frame by frame and records the times in milliseconds.
class FollowedDrag {
 public:
  FollowedDrag(const FollowedEdit& edit, double budget_ms)
      : edit_(edit), budget_ms_(budget_ms), drag_(edit.solver()) {
    drag_.wait_until_prepared();
    std::this_thread::sleep_for(kBeforeDrag);
    step(0.0, {});
  }

  // Moves the handle along the whole motion. Returns some poses, each with the completed fraction
  // of the motion. The caller checks the poses after the drag, because checks during the drag would
  // give background work extra time.
  std::vector<std::pair<double, DragState>> move() {
    std::vector<std::pair<double, DragState>> poses;
    for (int k = 1; k <= kFrames; ++k) {
      const double share = share_of(k);
      const auto next = std::chrono::steady_clock::now() + kFrameInterval;
      const Stopwatch watch;
      step(share, [&](double ms) { return watch.elapsed_ms() + ms < budget_ms_; });
      frames_ms.push_back(watch.elapsed_ms());
      iterations += drag_.state().last_result.iterations;
      if (k % kFramesPerCheck == 0) poses.emplace_back(share, drag_.state());
      // Background work has the rest of a sixtieth of a second.
      std::this_thread::sleep_until(next);
    }
    return poses;
  }

  // Computes frames with an unmoving handle until the surface has settled, but for at most `end_ms`
  // after the motion.
  const DragState& rest_until(double end_ms) {
    const MinimizerResult& last = drag_.state().last_result;
    while (rest_ms < end_ms && !last.settled && !last.exhausted) {
      const Stopwatch watch;
      step(1.0, [&](double ms) { return ms == 0.0 || watch.elapsed_ms() + ms < kRestFrame_ms; });
      rest_ms += watch.elapsed_ms();
    }
    return drag_.state();
  }

  std::vector<double> frames_ms;
  int iterations = 0;
  double rest_ms = 0.0;

 private:
  void step(double share, const TimeBudget& go_on) {
    drag_.step(std::array{edit_.part(share)}, go_on);
  }

  const FollowedEdit& edit_;
  double budget_ms_;
  DragSession drag_;
};

std::string text_of(const char* format, double percent) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), format, percent);
  return text.data();
}

// The frames that a device computes, by their CPU twin and, if a device is given, by itself.
class DeviceFrames {
 public:
  DeviceFrames(const FollowedEdit& edit, const std::string& device)
      : edit_(edit), drag_(ProxyDrag::make(edit.solver())) {
    if (drag_ == nullptr) return;
    const std::vector<Vector3d> start = drag_->begin({});
    twin_.emplace(drag_->problem());
    twin_->begin(start);
    if (device.empty()) return;
    context_ = open_bench_device(device).context;
    if (context_ == nullptr) throw InputError("--device needs a Vulkan device");
    frame_ = VulkanKernels(context_, Precision::float32).make_drag_frame(drag_->problem());
    frame_->begin(start);
    commands_.emplace(*context_, "drag frame");
  }

  // Drags there, and with a device also back. Returns whether the edit has such frames.
  bool run() {
    if (drag_ == nullptr) return false;
    HandleMotions motions;
    const int frames = frame_ == nullptr ? kFrames : 2 * kFrames;
    for (int k = 1; k <= frames; ++k) {
      motions = followed(motions, std::array{edit_.part(share_of(k))});
      const DragFrameInput* const input = drag_->step(motions);
      if (input == nullptr) return false;
      twin_->step(*input);
      if (frame_ != nullptr) step_on_device(*input);
      if (k > kFrames || k % kFramesPerCheck != 0) continue;
      off_percent =
          std::max(off_percent, edit_.off_percent(share_of(k), drag_->pose(twin_->displacement())));
    }
    return true;
  }

  double off_percent = 0.0;      // the largest distance from the settled surface
  double differs_percent = 0.0;  // the largest distance between device and twin

 private:
  void step_on_device(const DragFrameInput& input) {
    frame_->set_input(input);
    gpu::Recorder recorder(*commands_);
    frame_->record(recorder);
    recorder.finish();
    commands_->run();
    differs_percent = std::max(
        differs_percent, edit_.distance_percent(frame_->displacement(), twin_->displacement()));
  }

  const FollowedEdit& edit_;
  std::unique_ptr<ProxyDrag> drag_;
  std::optional<CpuDragFrame> twin_;
  std::shared_ptr<gpu::Context> context_;
  std::unique_ptr<VulkanDragFrame> frame_;
  std::optional<gpu::CommandList> commands_;
};

void follow(const FollowBench& settings, const std::string& name, const Mesh& mesh,
            EndsMotion motion) {
  const FollowedEdit edit(mesh, motion);
  const double budget_ms =
      settings.budget_ms > 0.0 ? settings.budget_ms : frame_budget_ms(mesh.vertex_count());
  FollowedDrag drag(edit, budget_ms);
  const auto checked = drag.move();
  const DragState rested = drag.rest_until(kRest_ms);
  drag.rest_until(kLongestRest_ms);
  const double rest_off = edit.off_percent(1.0, rested);
  double off = 0.0;
  double linear_off = 0.0;
  for (const auto& [share, pose] : checked) {
    Positions settled;
    off = std::max(off, edit.off_percent(share, pose, &settled));
    linear_off = std::max(linear_off, edit.distance_percent(edit.linear(share), settled));
  }
  DeviceFrames device(edit, settings.device);
  const bool has_frames = device.run();
  std::printf("%-20s %-5s %9zu %7.0f %7.2f %7.2f %6.2f %7.2f %7s %8s %7.2f %8.4f %8.0f\n",
              name.c_str(), std::string(name_of(motion)).c_str(), mesh.vertex_count(), budget_ms,
              median_of(drag.frames_ms), *std::ranges::max_element(drag.frames_ms),
              static_cast<double>(drag.iterations) / kFrames, off,
              has_frames ? text_of("%.2f", device.off_percent).c_str() : "-",
              settings.device.empty() || !has_frames
                  ? "-"
                  : text_of("%.1e", device.differs_percent).c_str(),
              linear_off, rest_off, drag.rest_ms);
  std::fflush(stdout);
}

}  // namespace

void bench_follow(const FollowBench& settings) {
  std::printf(
      "Drags of half a second, each frame in a time budget. \"off\" is the largest distance of a\n"
      "vertex from the settled surface in percent of the diagonal: of frames, of device frames\n"
      "(ProxyDrag), of the linear response, and half a second after the drag. \"differs\" is the\n"
      "largest distance between the frames of --device and their CPU twin. \"settled\" is the "
      "time\n"
      "from the end of the drag. In ms.\n\n"
      "%-20s %-5s %9s %7s %7s %7s %6s %7s %7s %8s %7s %8s %8s\n",
      "mesh", "", "vertices", "budget", "median", "most", "iter.", "off", "device", "differs",
      "linear", "rest", "settled");
  for (const std::string& file : settings.meshes) {
    const std::string name = std::filesystem::path(file).stem().string();
    try {
      Mesh mesh = read_mesh(file);
      for (int k = 0; k < settings.subdivisions; ++k) mesh = subdivide(mesh);
      for (const EndsMotion motion : kEndsMotions) follow(settings, name, mesh, motion);
    } catch (const Error& error) {
      std::printf("%-20s %s\n", name.c_str(), error.what());
    }
  }
}

}  // namespace lapwing::bench
