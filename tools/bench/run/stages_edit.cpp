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
#include "lapwing/deform/proxy_drag.h"
#include "lapwing/deform/turn_tracker.h"
#include "lapwing/elastic/energy_minimizer.h"
#include "lapwing/elastic/prepared_region.h"
#include "lapwing/render/surface.h"
#include "lapwing/vulkan/vulkan_drag_frame.h"
#include "lapwing/vulkan/vulkan_kernels.h"
#include "run/bench_run.h"
#include "run/edit_parts.h"

namespace lapwing::bench {
namespace {

// Tolerance of a surface that looks settled while the handle still moves, in mean edge lengths.
constexpr double kSettleTolerance = 1e-3;
// Iterations per counted run, enough to make its constant costs negligible.
constexpr int kSettleIterations = 20;

// Uploads the response to a device that draws; returns null without one.
std::shared_ptr<BlendResponse> uploaded(const DragResponse& response, const Subject& subject,
                                        const BenchDevice& device) {
  if (device.context == nullptr) return nullptr;
  return upload_response(device.context, response.columns(), subject.mesh.topology());
}

// The least that each kernel of a device frame must read and write in float32, if each vertex is
// read once from memory and then from the cache.
struct FrameBytes {
  explicit FrameBytes(const DragFrameProblem& problem) {
    const std::uint64_t vertices = problem.vertices.size();
    const std::uint64_t rows = problem.rings->row_count();
    const std::uint64_t entries = problem.rings->neighbours.size();
    const std::uint64_t unknowns = problem.inverse_diagonal.size();
    // Displacement, rest, nodes and entry in; displacement out.
    prolongate = vertices * (24 + 12 + 4 * kEmbeddingNodes + 4 + 24);
    // Neighbour, edge and two weights per entry; displacement, start and weight per row in;
    // rotation, residual and energy out.
    fit_rotations = entries * (4 + 12 + 4 + 4) + rows * (24 + 4 + 4 + 16 + 12 + 4);
    // The same entries; displacement, rotation, residual, start and unknown in; gradient out.
    energy_gradient = entries * (4 + 12 + 4 + 4) + rows * (24 + 16 + 12 + 4 + 4) + unknowns * 12;
    // Two displacements, unknown and entry in, one displacement out; gradient and diagonal in.
    smooth = vertices * (24 + 24 + 4 + 4 + 24) + unknowns * (12 + 4);
    // Displacement, rest and vertex in; position out.
    show_displacement = vertices * (24 + 12 + 4 + 12);
  }
  std::uint64_t prolongate;
  std::uint64_t fit_rotations;
  std::uint64_t energy_gradient;
  std::uint64_t smooth;
  std::uint64_t show_displacement;
};

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

// Measures the stages of an edit on one device.
class EditStages {
 public:
  EditStages(BenchRun& run, const BenchDevice& device)
      : run_(run), subject_(run.subject()), device_(device) {
    options_.memory_limit_bytes = run.settings().memory_bytes;
    options_.settle->tolerance = kSettleTolerance;
  }

  // A function that prepares an edit for a drag and returns an object that keeps the result alive.
  using Prepare = std::function<std::shared_ptr<const void>(PreparedRegion&, const EditRegion&,
                                                            const DeformOptions&)>;

  bool wants(const char* stage) const { return run_.wants(stage, device_); }

  void measure_preview() {
    if (!wants("first drag") && !wants("preview frame")) return;
    MovingHandle handle(subject_);
    std::optional<ShownDrag> drag;
    const auto make = [&] {
      const DragPreview preview(subject_.mesh.positions, subject_.mesh.topology(), subject_.region,
                                options_);
      drag.emplace(subject_, device_, preview.response());
      drag->move(handle.next());
    };
    run_.measure("first drag", device_, make, [&] { drag.reset(); });
    if (!drag) make();
    run_.measure("preview frame", device_, [&] { drag->move(handle.next()); });
  }

  // Measures the mean of many iterations from rest, on the system of a DeformSolver.
  void measure_settle_iteration() {
    if (!wants("settle iteration")) return;
    const EditParts parts(subject_);
    const LaplacianSystem system = parts.laplacian_system(subject_);
    SettleOptions options;
    options.max_iterations = kSettleIterations;
    options.tolerance = 1e-300;
    EnergyMinimizer settler(*device_.kernels, system, options);
    Positions wanted(subject_.vertices(), Eigen::Vector3d::Zero());
    const Eigen::Affine3d motion = subject_.motion(1.0);
    for (const Index v : subject_.region.handles[0]) {
      wanted[v] = motion * subject_.mesh.positions[v] - subject_.mesh.positions[v];
    }
    Positions u;
    Measurement* const row = run_.measure(
        "settle iteration", device_, [&] { settler.settle({wanted}, u); },
        [&] { u.assign(subject_.vertices(), Eigen::Vector3d::Zero()); });
    for (auto* const times : {&row->wall_ms, &row->cpu_ms, &row->device_ms}) {
      for (double& ms : *times) ms /= kSettleIterations;
    }
    row->counts["iterations"] = kSettleIterations;
  }

  Measurement* measure_frame(const std::string& stage, const BenchDevice& device,
                             const std::function<void()>& frame) {
    const bool on_device = device.context != nullptr;
    Measurement* const row = run_.measure(stage, device, frame);
    if (row != nullptr) {
      row->counts["bytes"] =
          blend_bytes(subject_, on_device) + (on_device ? normals_bytes(subject_) : 0);
    }
    return row;
  }

  // Measures a frame that the shaders compute. On a software device, too, the shaders compute it,
  // although the CPU usually computes the frames of such a device. The response has arbitrary
  // values.
  void measure_shader_frame() {
    if (device_.context == nullptr || !wants("shader frame")) return;
    const BenchDevice staged = open_bench_device(device_.name, false);
    std::vector<Index> moving(subject_.vertices());
    std::iota(moving.begin(), moving.end(), Index{0});
    std::vector<double> numbers(3 * moving.size() * kMotionParameters, 0.0);
    for (std::size_t i = 0; i < numbers.size(); ++i)
      numbers[i] = 1e-3 * static_cast<double>(i % 97);
    Surface surface(staged.context, subject_.mesh.positions, subject_.mesh.topology());
    const auto blend = upload_response(staged.context, {moving, kMotionParameters, numbers},
                                       subject_.mesh.topology());
    surface.begin(*blend, subject_.mesh.positions);
    std::vector<double> parameters(kMotionParameters, 1e-3);
    const auto frame = [&] {
      surface.blend(blend, parameters);
      surface.finish();
    };
    if (measure_frame("shader frame", staged, frame) == nullptr) return;
    run_.add_kernel("blend_response", blend_bytes(subject_, true));
    run_.add_kernel("vertex_normals", normals_bytes(subject_));
  }

  void measure_settle_frame(const std::shared_ptr<const DeformSolver>& solver) {
    MovingHandle handle(subject_);
    DragSession drag(solver);
    // Small meshes run the whole motion, because the handle is fastest in the middle.
    constexpr std::size_t kMostForTheWholeWay = 120'000;
    const int frames_there_and_back =
        subject_.vertices() <= kMostForTheWholeWay ? MovingHandle::kFramesOfMotion : 0;
    std::uint64_t iterations = 0;
    std::uint64_t frames = 0;
    Measurement* const row = run_.measure(
        "settle frame", device_,
        [&] {
          iterations += static_cast<std::uint64_t>(drag.step(handle.next()).last_result.iterations);
          ++frames;
        },
        {}, frames_there_and_back);
    // The number of iterations depends on rounding, so it is not a count.
    if (row == nullptr || run_.settings().only_counts) return;
    row->counts["iterations"] = iterations / frames;
  }

  // Measures a settled frame whose fine surface stays on the device: first the proxy on the CPU,
  // then the submission. In a viewer, both run at the same time. Several threads build the proxy,
  // so its allocations cannot be counted.
  void measure_device_frame(const std::shared_ptr<const DeformSolver>& solver) {
    if (device_.context == nullptr || run_.settings().only_counts) return;
    if (!wants("device settle frame")) return;
    const std::unique_ptr<ProxyDrag> drag = ProxyDrag::make(solver);
    if (drag == nullptr) return;
    MovingHandle handle(subject_);
    VulkanKernels kernels(device_.context, Precision::float32);
    const std::shared_ptr<VulkanDragFrame> frame = kernels.make_drag_frame(drag->problem());
    frame->begin(drag->begin({}));
    Surface surface(device_.context, subject_.mesh.positions, subject_.mesh.topology());
    HandleMotions motions;
    const DragFrameInput* input = nullptr;
    const Eigen::Vector3d centroid =
        handle_frame(subject_.region.handles[0], subject_.mesh.positions).centroid;
    const auto next = [&] {
      const Eigen::Affine3d map = handle.next()[0];
      Eigen::Affine3d rigid(shortest_turn(map));  // a stretch would need a DragSession
      rigid.pretranslate(map * centroid - rigid * centroid);
      motions = followed(motions, std::array{rigid});
      input = drag->step(motions);
    };
    run_.measure(
        "device settle frame", device_,
        [&] {
          surface.follow(frame, *input);
          surface.finish();
        },
        next, MovingHandle::kFramesOfMotion);
    const FrameBytes bytes(*drag->problem());
    run_.add_kernel("prolongate", bytes.prolongate);
    run_.add_kernel("fit_rotations", bytes.fit_rotations);
    run_.add_kernel("energy_gradient", bytes.energy_gradient);
    run_.add_kernel("smooth", bytes.smooth);
    run_.add_kernel("show_displacement", bytes.show_displacement);
    run_.measure("proxy frame", device_, next, {}, MovingHandle::kFramesOfMotion);
  }

  // The result of a frame depends on time, so there is no count.
  void measure_frame_in_time(const std::shared_ptr<const DeformSolver>& solver) {
    if (run_.settings().only_counts) return;
    const double budget = frame_budget_ms(subject_.vertices());
    MovingHandle handle(subject_);
    DragSession drag(solver);
    run_.measure(
        "settle frame in time", device_,
        [&] {
          const Stopwatch watch;
          drag.step(handle.next(), [&](double ms) { return watch.elapsed_ms() + ms < budget; });
        },
        {}, MovingHandle::kFramesOfMotion);
  }

  void measure_exact() {
    const bool frames = wants("drag frame") || wants("settle frame") ||
                        wants("settle frame in time") || wants("device settle frame");
    if (!frames && !wants("preparation")) return;
    MovingHandle handle(subject_);
    std::shared_ptr<const DeformSolver> solver;
    const auto make = [&] {
      solver =
          std::make_shared<const DeformSolver>(subject_.mesh.positions, subject_.mesh.topology(),
                                               subject_.region, options_, *device_.kernels);
      uploaded(*solver->response(), subject_, device_);
    };
    run_.measure("preparation", device_, make, [&] { solver.reset(); });
    if (!frames) return;
    if (solver == nullptr) make();
    ShownDrag drag(subject_, device_, solver->response());
    measure_frame("drag frame", device_, [&] { drag.move(handle.next()); });
    measure_settle_frame(solver);
    measure_frame_in_time(solver);
    measure_device_frame(solver);
  }

  // Prepares everything that a settled drag needs from its first frame on.
  std::shared_ptr<DragSession> settled_drag(PreparedRegion& prepared, const EditRegion& region,
                                            const DeformOptions& options) const {
    const DragPreview preview(prepared, subject_.mesh.positions, region, options);
    auto drag = std::make_shared<DragSession>(
        std::make_shared<const DeformSolver>(preview, *device_.kernels));
    drag->wait_until_prepared();
    return drag;
  }

  // Several threads allocate, so allocations cannot be counted.
  void measure_settled_preparation() {
    if (run_.settings().only_counts) return;
    std::shared_ptr<DragSession> drag;
    run_.measure(
        "settled preparation", device_,
        [&] {
          PreparedRegion prepared(subject_.mesh.topology());
          drag = settled_drag(prepared, subject_.region, options_);
        },
        [&] { drag.reset(); });
  }

  // Measures a preparation that follows another one of the same region. The first one and its
  // background results are destroyed by then.
  void measure_repreparation(const std::string& stage, const EditRegion& region,
                             const DeformOptions& options, const Prepare& prepare) {
    PreparedRegion prepared(subject_.mesh.topology());
    std::shared_ptr<const void> again;
    run_.measure(
        stage, device_, [&] { again = prepare(prepared, region, options); },
        [&] {
          again.reset();
          prepare(prepared, subject_.region, options_);
        });
  }

  void measure_all_again(const std::string& stage, const Prepare& prepare) {
    DeformOptions other_weight = options_;
    other_weight.constraint_weight = 10.0;
    DeformOptions other_laplacians = options_;
    other_laplacians.weights = LaplacianWeights::uniform;
    measure_repreparation(stage + ", other handle", with_other_handle(subject_), options_, prepare);
    measure_repreparation(stage + ", other belt", with_other_belt(subject_), options_, prepare);
    measure_repreparation(stage + ", other weight", subject_.region, other_weight, prepare);
    measure_repreparation(stage + ", other Laplacians", subject_.region, other_laplacians, prepare);
  }

  void measure_all_again() {
    // Each run needs another preparation before it, which takes too long on larger meshes.
    constexpr std::size_t kMostForAgain = 120'000;
    if (subject_.vertices() > kMostForAgain) return;
    measure_all_again("again", [&](PreparedRegion& prepared, const EditRegion& region,
                                   const DeformOptions& options) {
      auto solver = std::make_shared<const DeformSolver>(prepared, subject_.mesh.positions, region,
                                                         options, *device_.kernels);
      uploaded(*solver->response(), subject_, device_);
      return solver;
    });
    // Several threads allocate, so allocations cannot be counted.
    if (run_.settings().only_counts) return;
    measure_all_again("settled again", [&](PreparedRegion& prepared, const EditRegion& region,
                                           const DeformOptions& options) {
      return settled_drag(prepared, region, options);
    });
  }

 private:
  BenchRun& run_;
  const Subject& subject_;
  const BenchDevice& device_;
  DeformOptions options_;
};

}  // namespace

void measure_edit_stages(BenchRun& run) {
  std::vector<EditStages> stages;
  for (const BenchDevice& device : run.devices()) stages.emplace_back(run, device);
  for (EditStages& of_device : stages) of_device.measure_preview();
  for (EditStages& of_device : stages) of_device.measure_settle_iteration();
  for (EditStages& of_device : stages) of_device.measure_shader_frame();
  for (EditStages& of_device : stages) {
    of_device.measure_settled_preparation();
    of_device.measure_exact();
    of_device.measure_all_again();
  }
}

}  // namespace lapwing::bench
