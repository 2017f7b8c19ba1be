#include <algorithm>
#include <functional>
#include <memory>
#include <numeric>
#include <optional>
#include <vector>

#include "lapwing/deform/deform_solver.h"
#include "lapwing/deform/drag.h"
#include "lapwing/deform/drag_preview.h"
#include "lapwing/deform/drag_session.h"
#include "lapwing/deform/handle_motion.h"
#include "lapwing/elastic/energy_minimizer.h"
#include "lapwing/elastic/prepared_region.h"
#include "lapwing/render/surface.h"
#include "run/edit_parts.h"
#include "run/stages.h"

namespace lapwing::bench {
namespace {

// Tolerance of a surface that looks settled while the handle still moves, in mean edge lengths.
constexpr double kSettleTolerance = 1e-3;
// Iterations per counted run, enough to make its constant costs negligible.
constexpr int kSettleIterations = 20;

DeformOptions deform_options(const BenchRun& run) {
  DeformOptions options;
  options.memory_limit_bytes = run.settings().memory_bytes;
  options.settle->tolerance = kSettleTolerance;
  return options;
}

// Uploads the response to a device that draws; returns null without one.
std::shared_ptr<BlendResponse> uploaded(const DragResponse& response, const Subject& subject,
                                        const BenchDevice& device) {
  if (device.context == nullptr) return nullptr;
  return upload_response(device.context, response.columns(), subject.mesh.topology());
}

// A drag as a user sees it: the response moves the vertices of the drawn surface, and the normals
// follow. Without a device that draws, it moves only the vertices, in double precision.
class ShownDrag {
 public:
  ShownDrag(const Subject& subject, const BenchDevice& device,
            std::shared_ptr<const DragResponse> response)
      : drag_(std::move(response)), blend_(uploaded(*drag_.response(), subject, device)) {
    if (device.context == nullptr) {
      positions_ = subject.mesh.positions;
      return;
    }
    surface_.emplace(device.context, subject.mesh.positions, subject.mesh.topology());
    surface_->begin(*blend_, subject.mesh.positions);
  }

  void move(std::span<const Eigen::Affine3d> motions) {
    if (surface_) {
      surface_->blend(blend_, drag_.parameters(motions));
      surface_->finish();
      return;
    }
    drag_.move(motions, positions_);
  }

 private:
  Drag drag_;
  std::shared_ptr<BlendResponse> blend_;
  std::optional<Surface> surface_;
  Positions positions_;
};

// The least that a frame must read and write. Blending takes columns, rest, numbers and positions;
// normals, if drawn, take numbers, fans, positions and normals. All twelve columns are in use.
std::uint64_t blend_bytes(const Subject& subject, bool on_device) {
  const std::uint64_t n = subject.vertices();
  const std::uint64_t number = on_device ? sizeof(float) : sizeof(double);
  const std::uint64_t rest = on_device ? 4 * number : 3 * number;
  return n * (36 * number + rest + sizeof(Index) + 3 * number);
}

std::uint64_t normals_bytes(const Subject& subject) {
  const std::uint64_t n = subject.vertices();
  const std::uint64_t corners = subject.mesh.topology().vertex_triangles.values.size();
  return sizeof(Index) * (corners + n) + n * (2 * sizeof(Index) + 8 * sizeof(float));
}

Measurement* measure_frame(BenchRun& run, const Subject& subject, const BenchDevice& device,
                           const std::string& stage, const std::function<void()>& frame) {
  const bool on_device = device.context != nullptr;
  Measurement* const row = run.measure(stage, kLapwing, device, subject, frame);
  if (row != nullptr) {
    row->counts["bytes"] =
        blend_bytes(subject, on_device) + (on_device ? normals_bytes(subject) : 0);
  }
  return row;
}

// Measures a frame by the shaders, even on a software device, where the processor usually replaces
// them. The response is made up.
void measure_shader_frame(BenchRun& run, const Subject& subject, const BenchDevice& device) {
  if (device.context == nullptr) return;
  if (!run.wants("shader frame", kLapwing, device.name, subject)) return;
  const BenchDevice staged = open_bench_device(device.name, false);
  std::vector<Index> moving(subject.vertices());
  std::iota(moving.begin(), moving.end(), Index{0});
  std::vector<double> numbers(3 * moving.size() * kMotionParameters, 0.0);
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = 1e-3 * static_cast<double>(i % 97);
  Surface surface(staged.context, subject.mesh.positions, subject.mesh.topology());
  const auto blend = upload_response(staged.context, {moving, kMotionParameters, numbers},
                                     subject.mesh.topology());
  surface.begin(*blend, subject.mesh.positions);
  std::vector<double> parameters(kMotionParameters, 1e-3);
  const auto frame = [&] {
    surface.blend(blend, parameters);
    surface.finish();
  };
  if (measure_frame(run, subject, staged, "shader frame", frame) == nullptr) return;
  run.add_kernel("blend_response", blend_bytes(subject, true));
  run.add_kernel("vertex_normals", normals_bytes(subject));
}

void measure_preview(BenchRun& run, const Subject& subject, const BenchDevice& device) {
  const bool wanted = run.wants("first drag", kLapwing, device.name, subject) ||
                      run.wants("preview frame", kLapwing, device.name, subject);
  if (!wanted) return;
  const DeformOptions options = deform_options(run);
  MovingHandle handle(subject);
  std::optional<ShownDrag> drag;
  const auto make = [&] {
    const DragPreview preview(subject.mesh.positions, subject.mesh.topology(), subject.region,
                              options);
    drag.emplace(subject, device, preview.response());
    drag->move(handle.next());
  };
  run.measure("first drag", kLapwing, device, subject, make, [&] { drag.reset(); });
  if (!drag) make();
  run.measure("preview frame", kLapwing, device, subject, [&] { drag->move(handle.next()); });
}

void measure_settle_frame(BenchRun& run, const Subject& subject, const BenchDevice& device,
                          const std::string& stage,
                          const std::shared_ptr<const DeformSolver>& solver) {
  MovingHandle handle(subject);
  DragSession drag(solver);
  // Small meshes run the whole motion, because the handle is fastest in the middle.
  constexpr std::size_t kMostForTheWholeWay = 120'000;
  const int frames_there_and_back =
      subject.vertices() <= kMostForTheWholeWay ? MovingHandle::kFramesOfMotion : 0;
  std::uint64_t iterations = 0;
  std::uint64_t frames = 0;
  Measurement* const row =
      run.measure(stage, kLapwing, device, subject, frames_there_and_back, [&] {
        iterations += static_cast<std::uint64_t>(drag.step(handle.next()).last_result.iterations);
        ++frames;
      });
  // The number of iterations depends on rounding, so it is not a count.
  if (row == nullptr || run.settings().only_counts) return;
  row->counts["iterations"] = iterations / frames;
}

// The result of a frame depends on time, so there is no count.
void measure_frame_in_time(BenchRun& run, const Subject& subject, const BenchDevice& device,
                           const std::shared_ptr<const DeformSolver>& solver) {
  if (run.settings().only_counts) return;
  const double budget = frame_budget_ms(subject.vertices());
  MovingHandle handle(subject);
  DragSession drag(solver);
  run.measure("settle frame in time", kLapwing, device, subject, MovingHandle::kFramesOfMotion,
              [&] {
                const Stopwatch watch;
                drag.step(handle.next(),
                          [&](double ms) { return watch.elapsed_ms() + ms < budget; });
              });
}

void measure_exact(BenchRun& run, const Subject& subject, const BenchDevice& device) {
  const bool frames = run.wants("drag frame", kLapwing, device.name, subject) ||
                      run.wants("settle frame", kLapwing, device.name, subject) ||
                      run.wants("settle frame in time", kLapwing, device.name, subject);
  if (!frames && !run.wants("preparation", kLapwing, device.name, subject)) return;
  const DeformOptions options = deform_options(run);
  MovingHandle handle(subject);
  std::shared_ptr<const DeformSolver> solver;
  const auto make = [&] {
    solver = std::make_shared<const DeformSolver>(subject.mesh.positions, subject.mesh.topology(),
                                                  subject.region, options, *device.kernels);
    uploaded(*solver->response(), subject, device);
  };
  run.measure("preparation", kLapwing, device, subject, make, [&] { solver.reset(); });
  if (!frames) return;
  if (solver == nullptr) make();
  ShownDrag drag(subject, device, solver->response());
  measure_frame(run, subject, device, "drag frame", [&] { drag.move(handle.next()); });
  measure_settle_frame(run, subject, device, "settle frame", solver);
  measure_frame_in_time(run, subject, device, solver);
}

// Prepares everything that a settled drag needs from its first frame on.
std::shared_ptr<DragSession> settled_drag(PreparedRegion& prepared, const Subject& subject,
                                          const EditRegion& region, const DeformOptions& options,
                                          const BenchDevice& device) {
  const DragPreview preview(prepared, subject.mesh.positions, region, options);
  auto drag =
      std::make_shared<DragSession>(std::make_shared<const DeformSolver>(preview, *device.kernels));
  drag->wait_until_prepared();
  return drag;
}

// Several threads allocate, so allocations cannot be counted.
void measure_settled_preparation(BenchRun& run, const Subject& subject, const BenchDevice& device) {
  if (run.settings().only_counts) return;
  if (!run.wants("settled preparation", kLapwing, device.name, subject)) return;
  std::shared_ptr<DragSession> drag;
  run.measure(
      "settled preparation", kLapwing, device, subject,
      [&] {
        PreparedRegion prepared(subject.mesh.topology());
        drag = settled_drag(prepared, subject, subject.region, deform_options(run), device);
      },
      [&] { drag.reset(); });
}

// Returns the subject's region with another handle: as many vertices, just below the original one.
EditRegion with_other_handle(const Subject& subject) {
  EditRegion region = subject.region;
  const Positions& positions = subject.mesh.positions;
  VertexSet& handle = region.handles[0];
  const std::size_t size = handle.size();
  std::vector<Index> by_height(region.roi);
  std::stable_sort(by_height.begin(), by_height.end(),
                   [&](Index a, Index b) { return positions[a].y() > positions[b].y(); });
  handle.assign(by_height.begin() + static_cast<std::ptrdiff_t>(size),
                by_height.begin() + static_cast<std::ptrdiff_t>(2 * size));
  std::sort(handle.begin(), handle.end());
  return region;
}

// Returns the subject's region with half of the belt.
EditRegion with_other_belt(const Subject& subject) {
  EditRegion region = subject.region;
  region.belt.resize(region.belt.size() / 2);
  return region;
}

// Prepares an edit and all that its drag needs. Returns the owner, which is destroyed before the
// next preparation.
using Prepare = std::function<std::shared_ptr<const void>(PreparedRegion&, const EditRegion&,
                                                          const DeformOptions&)>;

// Measures a preparation that follows another one of the same region. The first one and its
// background results are destroyed by then.
void measure_repreparation(BenchRun& run, const Subject& subject, const BenchDevice& device,
                           const std::string& stage, const EditRegion& region,
                           const DeformOptions& options, const Prepare& prepare) {
  // Each run needs another preparation before it, which takes too long on larger meshes.
  constexpr std::size_t kMostForAgain = 120'000;
  if (subject.vertices() > kMostForAgain) return;
  if (!run.wants(stage, kLapwing, device.name, subject)) return;
  PreparedRegion prepared(subject.mesh.topology());
  std::shared_ptr<const void> again;
  run.measure(
      stage, kLapwing, device, subject, [&] { again = prepare(prepared, region, options); },
      [&] {
        again.reset();
        prepare(prepared, subject.region, deform_options(run));
      });
}

void measure_all_again(BenchRun& run, const Subject& subject, const BenchDevice& device,
                       const std::string& stage, const Prepare& prepare) {
  const DeformOptions options = deform_options(run);
  DeformOptions other_weight = options;
  other_weight.constraint_weight = 10.0;
  DeformOptions other_laplacians = options;
  other_laplacians.weights = LaplacianWeights::uniform;
  const auto measure = [&](const char* change, const EditRegion& region,
                           const DeformOptions& changed) {
    measure_repreparation(run, subject, device, stage + ", other " + change, region, changed,
                          prepare);
  };
  measure("handle", with_other_handle(subject), options);
  measure("belt", with_other_belt(subject), options);
  measure("weight", subject.region, other_weight);
  measure("Laplacians", subject.region, other_laplacians);
}

void measure_all_again(BenchRun& run, const Subject& subject, const BenchDevice& device) {
  measure_all_again(
      run, subject, device, "again",
      [&](PreparedRegion& prepared, const EditRegion& region, const DeformOptions& options) {
        auto solver = std::make_shared<const DeformSolver>(prepared, subject.mesh.positions, region,
                                                           options, *device.kernels);
        uploaded(*solver->response(), subject, device);
        return solver;
      });
  // Several threads allocate, so allocations cannot be counted.
  if (run.settings().only_counts) return;
  measure_all_again(
      run, subject, device, "settled again",
      [&](PreparedRegion& prepared, const EditRegion& region, const DeformOptions& options) {
        return settled_drag(prepared, subject, region, options, device);
      });
}

// Measures the mean of many iterations from rest, on the system of a DeformSolver.
void measure_settle_iteration(BenchRun& run, const Subject& subject, const BenchDevice& device) {
  if (!run.wants("settle iteration", kLapwing, device.name, subject)) return;
  const EditParts parts(subject);
  const LaplacianSystem system = parts.laplacian_system(subject);
  SettleOptions options;
  options.max_iterations = kSettleIterations;
  options.tolerance = 1e-300;
  EnergyMinimizer settler(*device.kernels, system, options);
  Positions wanted(subject.vertices(), Eigen::Vector3d::Zero());
  const Eigen::Affine3d motion = subject.motion(1.0);
  for (const Index v : subject.region.handles[0]) {
    wanted[v] = motion * subject.mesh.positions[v] - subject.mesh.positions[v];
  }
  Positions u;
  Measurement* const row = run.measure(
      "settle iteration", kLapwing, device, subject, [&] { settler.settle({wanted}, u); },
      [&] { u.assign(subject.vertices(), Eigen::Vector3d::Zero()); });
  for (auto* const times : {&row->wall_ms, &row->cpu_ms, &row->device_ms}) {
    for (double& ms : *times) ms /= kSettleIterations;
  }
  row->counts["iterations"] = kSettleIterations;
}

}  // namespace

void measure_edit_stages(BenchRun& run, const Subject& subject) {
  for (const BenchDevice& device : run.devices()) measure_preview(run, subject, device);
  for (const BenchDevice& device : run.devices()) measure_settle_iteration(run, subject, device);
  for (const BenchDevice& device : run.devices()) measure_shader_frame(run, subject, device);
  for (const BenchDevice& device : run.devices()) {
    measure_settled_preparation(run, subject, device);
    measure_exact(run, subject, device);
    measure_all_again(run, subject, device);
  }
}

}  // namespace lapwing::bench
