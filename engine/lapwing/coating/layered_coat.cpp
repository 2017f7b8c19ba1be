#include "lapwing/coating/layered_coat.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <sstream>
#include <utility>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"
#include "lapwing/base/parallel.h"
#include "lapwing/base/stopwatch.h"
#include "lapwing/coating/ring_operators.h"
#include "lapwing/coating/sizing_field.h"
#include "lapwing/deform/certificate.h"
#include "lapwing/doctor/orientation.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

// Largest remeshed patch; larger ones take too long. For more vertices, users can remesh before
// coating.
constexpr double kMostVertices = 400'000;

// Returns whether both options lead to the same map of the target.
bool same_on_target(const CorrespondenceOptions& a, const CorrespondenceOptions& b) {
  return std::equal(a.boundary_pairs.begin(), a.boundary_pairs.end(), b.boundary_pairs.begin(),
                    b.boundary_pairs.end(),
                    [](const VertexPair& p, const VertexPair& q) { return p[1] == q[1]; });
}

// Throws SolverError if the result is not finite or the residual is too large, so that no invalid
// result is saved.
void require_valid(const Patch& patch, const Positions& positions, double relative_residual,
                   const std::string& where) {
  for (const Index v : patch.vertices) {
    if (positions[v].allFinite()) continue;
    throw SolverError(
        where + ": the result has a non-finite position at vertex " + std::to_string(v) +
            ", so the mesh is unchanged; run `lapwing check` on source and target, and reduce "
            "\"amplitude\" or \"scale\"",
        {v});
  }
  if (!(relative_residual <= kLargestResidual)) {
    std::ostringstream text;
    text << where << ": the relative residual of the solution is " << relative_residual
         << ", above the limit of " << kLargestResidual
         << ", so the mesh is unchanged; remesh the target patch with `lapwing remesh`, or choose "
            "a smaller patch";
    throw SolverError(text.str());
  }
}

}  // namespace

template <class Body>
void LayeredCoat::timed(const char* name, const Progress& progress, Body body) {
  stage(name, timings_, progress, body);
}

LayeredCoat::LayeredCoat(LayeredRequest request, const Mesh& mesh,
                         const std::vector<SharedSource>& sources, Kernels& kernels,
                         const Progress& progress)
    : request_(std::move(request)), mesh_(mesh), kernels_(kernels) {
  const ProgressScope scope(progress);
  for (std::size_t k = 0; k < request_.sources.size(); ++k) {
    const CoatSource& source = request_.sources[k];
    // With one source, `positions` applies the amplitude.
    layers_.push_back({SourceSide(source, sources.at(k), mesh),
                       source.correspondence(request_.parameters.domain),
                       request_.weight ? source.amplitude : 1.0});
  }
  make_sides(progress);
  note_inward_sides();
  remesh_where_coarse(progress);
  take(progress);
  note_held_scales();
  note_wide_transition();
}

// Prepares sources and target in parallel. Only the sources use the device.
void LayeredCoat::make_sides(const Progress& progress) {
  const auto take_sources = [&] {
    for (Layer& layer : layers_) {
      layer.source.take(request_.transfer, layer.source.asked().detail_size,
                        request_.parameters.weights, kernels_);
    }
  };
  const auto find_target = [&] {
    target_.emplace(request_.target_patch, mesh_);
    target_->choose_handles(request_.handles);
    if (request_.weight) {
      target_->carry(weight_field(*request_.weight, mesh_, request_.where + "/weight"));
    }
  };
  timed("peel", progress, [&] {
    if (request_.transfer == TransferMode::coating) {
      parallel_invoke(take_sources, [&] {
        find_target();
        lay_target();
      });
    } else {  // the target's smoothing length depends on the sources
      parallel_invoke(take_sources, find_target);
      lay_target();
    }
  });
  timed("map", progress, [&] {
    parallel_invoke(
        [&] {
          for (Layer& layer : layers_) layer.source.lay(layer.pairs);
        },
        [&] { make_coater(); });
    meet();
  });
}

// Maps the smooth target, so that the detail does not influence the map.
void LayeredCoat::lay_target() {
  target_->smooth(target_size(), request_.parameters.weights);
  for (Layer& layer : layers_) {
    const Layer& first = layers_.front();
    layer.laid_target =
        &layer != &first && same_on_target(layer.pairs, first.pairs)
            ? first.laid_target
            : lay(target_->placed(), MapSide::target, layer.pairs, layer.source.asked().where);
  }
  if (request_.weight) {
    weights_ = mix_weights(*request_.weight, target_->field(), target_->patch(),
                           layers_.front().laid_target.map, request_.where + "/weight");
  }
}

void LayeredCoat::meet() {
  for (Layer& layer : layers_) {
    layer.map = correspond(layer.source.placed(), layer.source.laid(), target_->placed(),
                           layer.laid_target, layer.pairs, layer.source.asked().where);
  }
}

void LayeredCoat::remesh_where_coarse(const Progress& progress) {
  if (request_.parameters.remesh == Remeshing::none) return;
  std::vector<SizingField> lengths;
  for (const Layer& layer : layers_) {
    SizingField length(layer.source.coating(), target_->patch(), target_->own_positions(),
                       layer.map.points);
    if (!length.asks_for_remeshing()) continue;
    if (length.vertex_estimate() > kMostVertices) {
      warnings_.push_back(
          {layer.source.asked().where +
               ": the source is so much finer than the target that the patch would need " +
               std::to_string(static_cast<std::size_t>(length.vertex_estimate())) +
               " vertices; it gets fewer, and the finest detail is lost. To keep it, refine the "
               "target "
               "with `lapwing remesh` first",
           Advice::refine_target});
      length.limit_vertices(kMostVertices);
    }
    lengths.push_back(std::move(length));
  }
  if (lengths.empty()) return;
  const auto shortest = [&](const Vector3d& point) {
    double least = lengths.front()(point);
    for (std::size_t k = 1; k < lengths.size(); ++k) least = std::min(least, lengths[k](point));
    return least;
  };
  timed("remesh", progress, [&] {
    vertices_before_remeshing_ = target_->patch().vertices.size();
    coater_.reset();
    const std::string note = target_->remesh(shortest, progress);
    if (!note.empty()) warnings_.push_back({note});
    for (Layer& layer : layers_) {
      // Keep the pins; choosing them again on the new triangles could return other positions.
      layer.pairs.boundary_pairs = layer.map.pins;
      for (auto& [source, target] : layer.pairs.boundary_pairs) {
        target = target_->renumbered(target, true);
      }
      for (auto& [source, target] : layer.pairs.inner_pairs) {
        target = target_->renumbered(target, false);
      }
    }
    lay_target();
  });
  timed("map", progress, [&] { meet(); });
  make_coater();
}

// Returns the size below which the target's detail is removed; 0 means none.
double LayeredCoat::target_size() const {
  if (request_.transfer == TransferMode::coating || request_.parameters.smooth_target > 0.0) {
    return request_.parameters.smooth_target;
  }
  // The target's frames should have the same frequencies as those of the sources.
  const double area = surface_area(target_->patch().triangles, target_->own_positions());
  double sum = 0.0;
  for (const Layer& layer : layers_) {
    const Coating& coating = layer.source.coating();
    sum += layer.source.asked().detail_size *
           std::sqrt(area / surface_area(coating.patch.triangles, coating.positions));
  }
  return sum / static_cast<double>(layers_.size());
}

// Returns the ratio of lengths on the target patch to lengths on the source.
double LayeredCoat::ratio(const Layer& layer) const {
  const Coating& coating = layer.source.coating();
  return std::sqrt(surface_area(target_->patch().triangles, target_->placed().positions) /
                   surface_area(coating.patch.triangles, coating.smooth));
}

// Returns the mean of a length of the first and of the second source, weighted by the mean mix
// weight.
double LayeredCoat::of_both(double first, double second) const {
  const double w =
      std::accumulate(weights_.begin(), weights_.end(), 0.0) / static_cast<double>(weights_.size());
  return (1.0 - w) * first + w * second;
}

CoaterOptions LayeredCoat::coater_options() const {
  std::vector<double> details;
  for (const Layer& layer : layers_) {
    details.push_back(ratio(layer) * layer.source.asked().detail_size);
  }
  CoaterOptions options;
  options.weights = request_.parameters.weights;
  double width = details.front();
  if (!request_.weight) {
    options.hold_length = details.front();
  } else {
    width = of_both(details.front(), details.back());
    for (const double w : weights_) {
      options.hold_lengths.push_back((1.0 - w) * details.front() + w * details.back());
    }
  }
  options.transition =
      request_.parameters.transition.value_or(Transition{width, Transition::Profile::smooth});
  return options;
}

// Reports no progress, because another thread may report it at the same time.
void LayeredCoat::make_coater() {
  coater_.reset();
  const std::vector<HeldVertex> held = target_->held();
  CoatTarget target{.rest = target_->mesh().positions};
  if (target_size() > 0.0) target.smooth = target_->smooth_positions();
  target.whole = request_.transfer == TransferMode::shape;
  target.held = held;
  options_ = coater_options();
  try {
    coater_.emplace(target, target_->mesh().topology(), target_->patch(), options_, kernels_);
  } catch (const InputError& error) {
    throw InputError(request_.target_patch.where + ": " + error.what(), error.vertices());
  }
}

void LayeredCoat::take(const Progress& progress) {
  std::array<std::vector<double>, 2> shares;
  std::vector<CoatLayer> layers;
  for (std::size_t k = 0; k < layers_.size(); ++k) {
    const Layer& layer = layers_[k];
    for (const double w : weights_) {
      shares[k].push_back(layer.amplitude * (k == 0 ? 1.0 - w : w));
    }
    layers.push_back(
        {layer.source.coating(), layer.map.points, layer.source.asked().sampling, shares[k]});
  }
  coater_->take(layers, progress);
}

void LayeredCoat::set_detail_size(std::size_t k, double size, const Progress& progress) {
  const ProgressScope scope(progress);
  layers_.at(k).source.take(request_.transfer, size, request_.parameters.weights, kernels_);
  take(progress);
}

Positions LayeredCoat::positions(double amplitude) const {
  Positions positions = coater_->coat(amplitude);
  require_valid(target_->patch(), positions, coater_->relative_residual(), request_.where);
  return positions;
}

// Warns if the scale is limited at more than 1 % of the vertices. A smaller part, such as a tip, is
// not visible.
void LayeredCoat::note_held_scales() {
  const std::size_t count = target_->patch().vertices.size();
  for (std::size_t k = 0; k < layers_.size(); ++k) {
    const std::size_t held = coater_->scales()[k].held;
    if (100 * held <= count) continue;
    std::ostringstream text;
    text << layers_[k].source.asked().where << ": at " << held << " of the target patch's " << count
         << " vertices, the local scale of the coating would exceed " << kLargestLocalScale
         << " times the scale of the patches, so it is limited to that. Choose a rounder patch, "
            "without horns or legs, or give \"scale\"";
    warnings_.push_back({text.str(), Advice::set_scale, coater_->scales()[k].mean, k});
  }
}

// Adds warnings about surfaces that face inward. If only one of source and target faces inward, the
// transferred detail points inward.
void LayeredCoat::note_inward_sides() {
  const auto note = [&](const std::string& where, const char* effect, Facing facing,
                        std::optional<std::size_t> source) {
    const bool is_closed = facing == Facing::inside_out;
    warnings_.push_back(
        {where + ": the surface " + (is_closed ? "is inside out" : "has inward normals") + ", so " +
             effect + "; " +
             (is_closed ? "turn it with `lapwing check MESH --fix OUT`" : "reverse its faces") +
             ", or negate \"amplitude\"",
         Advice::negate_amplitude, 0.0, source});
  };
  const Facing target = facing_of(mesh_, target_->patch().vertices.front());
  bool is_target_noted = false;
  for (std::size_t k = 0; k < layers_.size(); ++k) {
    const Layer& layer = layers_[k];
    const Index vertex = layer.source.coating().patch.vertices.front();
    const Facing source = facing_of(layer.source.mesh(), vertex);
    if ((source == Facing::outward) == (target == Facing::outward)) continue;
    if (source != Facing::outward) {
      note(layer.source.asked().patch.where, "its bumps become dents", source, k);
    } else if (!std::exchange(is_target_noted, true)) {
      note(request_.target_patch.where, "bumps on it go inward", target, {});
    }
  }
}

// Adds a warning if the wide transition hides most of the coating.
void LayeredCoat::note_wide_transition() {
  constexpr double kMostOfIt = 0.9;
  const double share = coater_->largest_share();
  if (share >= kMostOfIt) return;
  std::ostringstream text;
  text << request_.where << ": the transition of " << options_.transition.width
       << " exceeds the depth of the target patch, so at most " << std::lround(100.0 * share)
       << "% of the coating is visible; choose a larger patch or a narrower \"transition\"";
  warnings_.push_back(
      {text.str(), Advice::set_transition_width, share * options_.transition.width});
}

StageTimings LayeredCoat::timings() const {
  StageTimings timings = timings_;
  for (const auto& [name, ms] : coater_->timings().stages()) timings.add(name, ms);
  return timings;
}

CoatReport LayeredCoat::report(const Positions& result) const {
  CoatReport report;
  for (std::size_t k = 0; k < layers_.size(); ++k) {
    const Correspondence& map = layers_[k].map;
    report.sources.push_back({.vertices = source_patch(k).vertices.size(),
                              .pins = map.pins,
                              .flipped_source = map.flipped_source,
                              .flipped_target = map.flipped_target,
                              .warp_steps = map.warp.steps,
                              .constrained_steps = map.warp.constrained_steps,
                              .mean_scale = coater_->scales()[k].mean});
  }
  report.vertices_before_remeshing = vertices_before_remeshing_;
  report.transition_width = options_.transition.width;
  report.relative_residual = coater_->relative_residual();
  for (std::size_t v = 0; v < result.size(); ++v) {
    const double distance = (result[v] - mesh().positions[v]).norm();
    if (!(distance > report.largest_displacement)) continue;
    report.largest_displacement = distance;
    report.largest_displacement_vertex = static_cast<Index>(v);
  }
  return report;
}

}  // namespace lapwing
