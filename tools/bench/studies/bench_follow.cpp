#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>
#include <thread>
#include <vector>

#include "lapwing/base/errors.h"
#include "lapwing/deform/deform_request.h"
#include "lapwing/deform/drag_session.h"
#include "lapwing/deform/handle_motion.h"
#include "lapwing/deform/turn_tracker.h"
#include "lapwing/elastic/prepared_region.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/mesh/subdivide.h"
#include "run/measure.h"
#include "run/subject.h"
#include "studies/real/ends_motion.h"
#include "studies/real/held_region.h"
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
// By then, background work for the first rest is done.
constexpr std::chrono::milliseconds kBeforeDrag{1000};
constexpr double kLongestRest_ms = 10'000.0;
// Time of a frame while the hand rests, as in the viewer.
constexpr double kRestFrame_ms = 50.0;
constexpr int kFramesPerCheck = 5;

class FollowedEdit {
 public:
  FollowedEdit(const Mesh& mesh, EndsMotion motion, bool again)
      : mesh_(mesh),
        ends_(moved_ends(motion, mesh.positions)),
        region_(held_region(ends_, mesh.positions, mesh.topology()).region),
        centroid_(handle_frame(region_.handles[0], mesh.positions).centroid),
        diagonal_(bounds_of(mesh.positions).diagonal()),
        prepared_(mesh.topology()) {
    if (again) prepare_other(motion);
    solver_ = std::make_shared<const DeformSolver>(prepared_, mesh.positions, region_,
                                                   DeformParameters{}, kernels_);
  }

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

  // Prepares and drops a drag with another handle and another belt.
  void prepare_other(EndsMotion motion) {
    const EndsMotion other = motion == EndsMotion::lift ? EndsMotion::lean : EndsMotion::lift;
    DragSession(std::make_shared<const DeformSolver>(prepared_, mesh_.positions,
                                                     held_region(moved_ends(other, mesh_.positions),
                                                                 mesh_.positions, mesh_.topology())
                                                         .region,
                                                     DeformParameters{}, kernels_))
        .wait_until_prepared();
  }
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
  PreparedRegion prepared_;
  std::shared_ptr<const DeformSolver> solver_;
  mutable std::shared_ptr<const DragResponse> response_;
  mutable std::unique_ptr<DragSession> reference_;
};

void follow(const FollowBench& settings, const std::string& name, const Mesh& mesh,
            EndsMotion motion) {
  const FollowedEdit edit(mesh, motion, settings.again);
  const double budget =
      settings.budget_ms > 0.0 ? settings.budget_ms : frame_budget_ms(mesh.vertex_count());
  Samples frames;
  DragSession drag(edit.solver());
  const DragState& pose = drag.state();
  const auto frame = [&](double share, const TimeBudget& go_on) {
    drag.step(std::array{edit.part(share)}, go_on);
  };
  const Stopwatch preparing;
  drag.wait_until_prepared();
  const double ready_ms = preparing.elapsed_ms();
  if (!settings.at_once) std::this_thread::sleep_for(kBeforeDrag);
  const Stopwatch first;
  frame(0.0, {});
  const double first_ms = first.elapsed_ms();
  int iterations = 0;
  // Checked at the end: during the drag, a check would give background work extra time.
  std::vector<std::pair<double, DragState>> checked;
  for (int k = 1; k <= kFrames; ++k) {
    const double share = 0.5 - 0.5 * std::cos(std::numbers::pi * k / kFrames);
    const auto next = std::chrono::steady_clock::now() + kFrameInterval;
    const Stopwatch watch;
    frame(share, [&](double ms) { return watch.elapsed_ms() + ms < budget; });
    frames.milliseconds.push_back(watch.elapsed_ms());
    iterations += pose.last_result.iterations;
    if (k % kFramesPerCheck == 0) checked.emplace_back(share, pose);
    // Background work has the rest of a sixtieth of a second.
    std::this_thread::sleep_until(next);
  }
  double rest_ms = 0.0;
  double longest_ms = 0.0;
  const auto rest_until = [&](double end_ms) {
    while (rest_ms < end_ms && !pose.last_result.settled && !pose.last_result.exhausted) {
      const Stopwatch watch;
      frame(1.0, [&](double ms) { return ms == 0.0 || watch.elapsed_ms() + ms < kRestFrame_ms; });
      longest_ms = std::max(longest_ms, watch.elapsed_ms());
      rest_ms += watch.elapsed_ms();
    }
  };
  rest_until(kRest_ms);
  const DragState rested = pose;
  rest_until(kLongestRest_ms);
  const double rest_off = edit.off_percent(1.0, rested);
  double off = 0.0;
  double linear_off = 0.0;
  for (const auto& [share, of_frame] : checked) {
    Positions settled;
    off = std::max(off, edit.off_percent(share, of_frame, &settled));
    linear_off = std::max(linear_off, edit.distance_percent(edit.linear(share), settled));
  }
  std::printf(
      "| %-20s | %-4s | %9zu | %7.0f | %7.1f | %6.0f | %6.2f | %6.2f | %5.2f | %6.2f | %6.2f | "
      "%8.4f | "
      "%7.0f | "
      "%7.0f |\n",
      name.c_str(), std::string(name_of(motion)).c_str(), mesh.vertex_count(), ready_ms, first_ms,
      budget, frames.median(), frames.max(), static_cast<double>(iterations) / kFrames, off,
      linear_off, rest_off, rest_ms, longest_ms);
  std::fflush(stdout);
}

}  // namespace

void bench_follow(const FollowBench& settings) {
  std::printf(
      "A drag of half a second, begun %s what frames without time need is there (ready),%s\n"
      "each frame in a given time: how far a vertex is at most from what the frame would settle "
      "to,\n"
      "in percent of the diagonal, beside the linear response; and so half a second after the "
      "hand\n"
      "has come to rest; when it has settled then, and the longest frame until then. In ms.\n\n"
      "| mesh                 |      |  vertices | ready   | first   | given  | median | most   "
      "| its.  | off    | linear | rest     | settled | longest |\n"
      "|----------------------|------|----------:|--------:|--------:|-------:|-------:|-------:"
      "|------:|-------:|-------:|---------:|--------:|--------:|\n",
      settings.at_once ? "when" : "a second after",
      settings.again ? "\nmade ready after one with another handle and another belt," : "");
  for (const std::string& file : settings.meshes) {
    const std::string name = std::filesystem::path(file).stem().string();
    try {
      Mesh mesh = read_mesh(file);
      for (int k = 0; k < settings.subdivisions; ++k) mesh = subdivide(mesh);
      for (const EndsMotion motion : kEndsMotions) follow(settings, name, mesh, motion);
    } catch (const Error& error) {
      std::printf("| %-20s | %s\n", name.c_str(), error.what());
    }
  }
}

}  // namespace lapwing::bench
