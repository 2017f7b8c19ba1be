#include "lapwing/session/run_coat.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <sstream>
#include <utility>

#include "lapwing/base/errors.h"
#include "lapwing/base/parallel.h"
#include "lapwing/coating/carried_length.h"
#include "lapwing/coating/coater.h"
#include "lapwing/coating/correspondence.h"
#include "lapwing/coating/fairing.h"
#include "lapwing/coating/peel.h"
#include "lapwing/coating/ring_areas.h"
#include "lapwing/deform/certificate.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/remesh/isotropic.h"
#include "lapwing/session/stage.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

// Where the coating comes from: a mesh of its own, or the target as it is before the step.
struct Source {
  Mesh own_mesh;
  Topology own_topology;
  const Mesh* mesh = nullptr;
  const Topology* topology = nullptr;
};

void load_source(const CoatStep& step, const std::filesystem::path& base_directory,
                 const RunResult& result, Source& source) {
  source.mesh = &result.mesh;
  source.topology = &result.topology;
  if (step.source.empty()) return;
  source.own_mesh = read_mesh(base_directory / step.source);
  source.own_topology = build_topology(source.own_mesh);
  source.mesh = &source.own_mesh;
  source.topology = &source.own_topology;
}

Patch patch_of(const RegionSpec& spec, const Mesh& mesh, const Topology& topology) {
  return disk_patch(resolve(spec, mesh, topology), topology, mesh.positions, spec.where);
}

struct Largest {
  double distance = 0.0;
  Index vertex = kNoIndex;
};

Largest largest_displacement(const Positions& before, const Positions& after) {
  Largest largest;
  for (std::size_t v = 0; v < before.size(); ++v) {
    const double distance = (after[v] - before[v]).norm();
    if (distance > largest.distance) largest = {distance, static_cast<Index>(v)};
  }
  return largest;
}

// More vertices than this are not worth waiting for; who wants them remeshes before.
constexpr double kMostVertices = 400'000;

// The target's side of a step, made anew when its patch is remeshed.
struct Target {
  Patch patch;
  Positions smooth;
  std::vector<Vector3d> laid;  // on the smooth surface, own numbers

  Target(Patch target_patch, const CoatStep& step, const RunResult& result)
      : patch(std::move(target_patch)), smooth(result.mesh.positions) {
    const CoatParameters& parameters = step.parameters;
    if (parameters.smooth_target > 0.0) {
      smooth = smooth_around(patch.vertices, parameters.smooth_target, result.mesh.positions,
                             result.topology, parameters.weights, "smooth_target");
    }
    laid = on_patch<Vector3d>(patch, smooth);
  }
};

// The pairs of `options` on the remeshed target: border vertices are still there, inner ones become
// the nearest that is none of the border.
void renumber_target(CorrespondenceOptions& options, const Positions& before,
                     const RemeshResult& remeshed) {
  std::vector<Index> now(before.size(), kNoIndex);
  for (Index v = 0; v < remeshed.kept.size(); ++v) {
    if (remeshed.kept[v] != kNoIndex) now[remeshed.kept[v]] = v;
  }
  for (auto& [source, target] : options.boundary_pairs) target = now[target];
  VertexSet inner = remeshed.region;
  std::erase_if(inner, [&](Index v) { return remeshed.kept[v] != kNoIndex; });
  if (inner.empty()) inner = remeshed.region;
  for (auto& [source, target] : options.inner_pairs) {
    const Vector3d place = before[target];
    target = *std::min_element(inner.begin(), inner.end(), [&](Index a, Index b) {
      return (remeshed.mesh.positions[a] - place).squaredNorm() <
             (remeshed.mesh.positions[b] - place).squaredNorm();
    });
  }
}

// Takes the remeshed target over; what was read of vertices that are new is where they are.
void replace_mesh(RemeshResult& remeshed, RunResult& result) {
  Positions original = remeshed.mesh.positions;
  for (std::size_t v = 0; v < original.size(); ++v) {
    if (remeshed.kept[v] != kNoIndex) original[v] = result.original[remeshed.kept[v]];
  }
  result.original = std::move(original);
  result.mesh = std::move(remeshed.mesh);
  result.topology = build_topology(result.mesh);
}

// One coat step on its way.
class CoatRun {
 public:
  CoatRun(const CoatStep& step, const std::filesystem::path& base_directory, Kernels& kernels,
          const Progress& progress, RunResult& result)
      : step_(step),
        base_directory_(base_directory),
        kernels_(kernels),
        progress_(progress),
        result_(result),
        pairs_(step.parameters.correspondence) {
    report_.op = "coat";
    report_.coat.emplace();
  }

  StepReport run();

 private:
  template <class Body>
  void timed(const char* name, Body body) {
    stage(name, report_.timings, progress_, body);
  }
  void make_sides();
  void lay_target(Target target);
  void meet();
  void remesh_where_coarse();
  CoaterOptions coater_options() const;
  void make_coater();
  void note_held_scales(const Coater& coater);
  void note_wide_transition(const Coater& coater);
  void coat();

  const CoatStep& step_;
  const std::filesystem::path& base_directory_;
  Kernels& kernels_;
  const Progress& progress_;
  RunResult& result_;
  CorrespondenceOptions pairs_;
  Coating coating_;
  std::optional<Target> target_;
  LaidPatch laid_source_;
  LaidPatch laid_target_;
  Correspondence map_;
  std::optional<Coater> coater_;
  StepReport report_;
};

// Source and target side by side; only the source uses the device.
void CoatRun::make_sides() {
  Source source;
  timed("source", [&] { load_source(step_, base_directory_, result_, source); });
  timed("peel", [&] {
    const CoatParameters& parameters = step_.parameters;
    parallel_invoke(
        [&] {
          coating_ = peel(patch_of(step_.source_patch, *source.mesh, *source.topology),
                          source.mesh->positions, *source.topology, parameters.detail_size,
                          parameters.weights, kernels_);
        },
        [&] {
          lay_target(
              Target(patch_of(step_.target_patch, result_.mesh, result_.topology), step_, result_));
        });
  });
  timed("map", [&] {
    parallel_invoke(
        [&] {
          laid_source_ =
              lay({coating_.patch, coating_.smooth}, MapSide::source, pairs_, step_.where);
        },
        [&] { make_coater(); });
    meet();
  });
}

// The surfaces below the detail are laid on each other: it has no say in where it comes to.
void CoatRun::lay_target(Target target) {
  target_ = std::move(target);
  laid_target_ = lay({target_->patch, target_->laid}, MapSide::target, pairs_, step_.where);
}

void CoatRun::meet() {
  map_ = correspond({coating_.patch, coating_.smooth}, laid_source_,
                    {target_->patch, target_->laid}, laid_target_, pairs_, step_.where);
}

void CoatRun::remesh_where_coarse() {
  if (step_.parameters.remesh == Remeshing::none) return;
  const Positions before = result_.mesh.positions;
  CarriedLength length(coating_, target_->patch, on_patch<Vector3d>(target_->patch, before),
                       map_.points);
  if (!length.asks_for_remeshing()) return;
  if (length.vertex_estimate() > kMostVertices) {
    result_.report.warnings.push_back(
        step_.where + ": the source is so much finer than the target that the patch would get " +
        std::to_string(static_cast<std::size_t>(length.vertex_estimate())) +
        " vertices; it gets fewer, and the finest detail is lost. `lapwing remesh` makes more");
    length.limit_vertices(kMostVertices);
  }
  timed("remesh", [&] {
    RemeshResult remeshed =
        remesh_isotropic(result_.mesh, target_->patch.vertices, std::cref(length), {}, progress_);
    if (!remeshed.note.empty()) result_.report.warnings.push_back(remeshed.note);
    // Chosen again on other triangles they could come out elsewhere.
    pairs_.boundary_pairs = map_.pins;
    renumber_target(pairs_, before, remeshed);
    const VertexSet region = remeshed.region;
    report_.coat->vertices_before_remeshing = target_->patch.vertices.size();
    replace_mesh(remeshed, result_);
    lay_target(Target(
        disk_patch(region, result_.topology, result_.mesh.positions, step_.target_patch.where),
        step_, result_));
  });
  timed("map", [&] { meet(); });
  make_coater();
}

CoaterOptions CoatRun::coater_options() const {
  const CoatParameters& parameters = step_.parameters;
  // How much larger the target patch is: lengths on the source become lengths there.
  const double ratio = std::sqrt(surface_area(target_->patch.triangles, target_->laid) /
                                 surface_area(coating_.patch.triangles, coating_.smooth));
  CoaterOptions options;
  options.weights = parameters.weights;
  options.hold_length = ratio * parameters.detail_size;
  options.transition = parameters.transition.value_or(
      Transition{ratio * parameters.detail_size, Transition::Profile::smooth});
  return options;
}

// Beside another thread, which has the progress.
void CoatRun::make_coater() {
  coater_.reset();
  CoatTarget target{result_.mesh.positions};
  if (step_.parameters.smooth_target > 0.0) target.smooth = target_->smooth;
  try {
    coater_.emplace(target, result_.topology, target_->patch, coater_options(), kernels_);
  } catch (const InputError& error) {
    throw InputError(step_.target_patch.where + ": " + error.what());
  }
}

// As a deform step's certificate does: a wrong mesh on the disk is worse than none.
void require_valid(const Patch& patch, const Positions& positions, double relative_residual,
                   const std::string& where) {
  for (const Index v : patch.vertices) {
    if (positions[v].allFinite()) continue;
    throw SolverError(where + ": the result has positions that are not finite, vertex " +
                      std::to_string(v) +
                      " for one, so the mesh was left as it was; run `lapwing check` on source and "
                      "target, and see that \"amplitude\" and \"scale\" are no larger than needed");
  }
  if (!(relative_residual <= kLargestResidual)) {
    std::ostringstream text;
    text << where << ": the solution misses the equations by " << relative_residual << " (at most "
         << kLargestResidual
         << " is allowed), so the mesh was left as it was; remesh the target patch with `lapwing "
            "remesh`, or choose a smaller one";
    throw SolverError(text.str());
  }
}

// A hundredth of the patch is the tip of something; nobody would see the difference.
void CoatRun::note_held_scales(const Coater& coater) {
  const std::size_t held = coater.held_scales();
  const std::size_t count = target_->patch.vertices.size();
  if (100 * held <= count) return;
  std::ostringstream text;
  text << step_.where << ": " << held << " of the target patch's " << count
       << " vertices are laid so close together on the source that the coating would be more than "
       << kLargestLocalScale
       << " times as large there as the patches' sizes say; it is held to that. Choose a rounder "
          "patch, without horns or legs, or give \"scale\"";
  result_.report.warnings.push_back(text.str());
}

// Somebody who sees nothing should know why.
void CoatRun::note_wide_transition(const Coater& coater) {
  constexpr double kMostOfIt = 0.9;
  const double share = coater.largest_share();
  if (share >= kMostOfIt) return;
  std::ostringstream text;
  text << step_.where << ": the transition of " << coater_options().transition.width
       << " is wider than the target patch is deep, so that at most " << std::lround(100.0 * share)
       << "% of the coating arrives; choose a larger patch or a narrower \"transition\"";
  result_.report.warnings.push_back(text.str());
}

void CoatRun::coat() {
  const CoatParameters& parameters = step_.parameters;
  CoatReport& report = *report_.coat;
  Coater& coater = *coater_;
  coater.take(coating_, map_.points, parameters.sampling, progress_);
  const Positions before = std::exchange(result_.mesh.positions, coater.coat(parameters.amplitude));
  note_held_scales(coater);
  note_wide_transition(coater);
  require_valid(target_->patch, result_.mesh.positions, coater.relative_residual(), step_.where);
  for (const auto& [name, ms] : coater.timings().stages()) report_.timings.add(name, ms);

  const Largest largest = largest_displacement(before, result_.mesh.positions);
  report_.free = coater.free().size();
  report.mean_scale = coater.mean_scale();
  report.transition_width = coater_options().transition.width;
  report.relative_residual = coater.relative_residual();
  report.largest_displacement = largest.distance;
  report.largest_displacement_vertex = largest.vertex;
}

StepReport CoatRun::run() {
  make_sides();
  remesh_where_coarse();
  coat();

  CoatReport& report = *report_.coat;
  report_.roi = target_->patch.vertices.size();
  report_.belt = target_->patch.loop.size();
  result_.region = {target_->patch.vertices, border_of(target_->patch), {}};
  report.source_vertices = coating_.patch.vertices.size();
  report.pins = map_.pins;
  report.flipped_source = map_.flipped_source;
  report.flipped_target = map_.flipped_target;
  report.warp_steps = map_.warp.steps;
  report.constrained_steps = map_.warp.constrained_steps;
  return std::move(report_);
}

}  // namespace

StepReport run_step(const CoatStep& step, const std::filesystem::path& base_directory,
                    Kernels& kernels, const Progress& progress, RunResult& result) {
  return CoatRun{step, base_directory, kernels, progress, result}.run();
}

}  // namespace lapwing
