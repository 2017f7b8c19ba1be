#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lapwing/base/stopwatch.h"
#include "lapwing/coating/coat_report.h"
#include "lapwing/coating/coat_request.h"
#include "lapwing/coating/source_side.h"
#include "lapwing/coating/target_side.h"

namespace lapwing {

/// What coats and mixes have in common: what comes from one or two sources to one target.
struct LayeredRequest {
  std::vector<CoatSource> sources;
  RegionSpec target_patch;
  CoatParameters parameters;
  std::string where;  ///< as in RegionSpec
  Taken taken = Taken::coating;
  std::optional<MixWeight> weight = {};  ///< of the second of two sources; none for one
  std::vector<MovedHandle> handles = {};
};

template <class Source>
LayeredRequest layered(const CoatOf<Source>& coat) {
  return {.sources = {coat.source},
          .target_patch = coat.target_patch,
          .parameters = coat.parameters,
          .where = coat.where};
}

template <class Source>
LayeredRequest layered(const MixOf<Source>& mix) {
  return {.sources = {mix.sources[0], mix.sources[1]},
          .target_patch = mix.target_patch,
          .parameters = mix.parameters,
          .where = mix.where,
          .taken = mix.taken,
          .weight = mix.weight,
          .handles = mix.handles};
}

/// A coat or mix made ready: sources taken off, the target smooth, both laid on each
/// other, the target remeshed where it is too coarse, its system factored, and what comes to it
/// solved for.
class LayeredCoat {
 public:
  /// `sources` are the meshes of the request's sources; null is the target itself. `mesh`,
  /// `topology` and `kernels` must outlive the object. Stages "peel", "map", "remesh", and those of
  /// `Coater`. Throws InputError for what does not fit, SolverError, and Cancelled.
  LayeredCoat(LayeredRequest request, const Mesh& mesh, const std::vector<SharedSource>& sources,
              Kernels& kernels, const Progress& progress = {});
  LayeredCoat(const LayeredCoat&) = delete;

  /// `mesh()` with `amplitude` times what the layers bring. One addition per vertex of the patch.
  /// Throws SolverError when positions are not finite or the solution misses the equations.
  Positions positions(double amplitude) const;

  /// Takes source `k` off anew with another detail size: one fairing of the source and one
  /// back-substitution. Maps, transition and the target's system stay those of the size that the
  /// object was made with, so that a step with the new one can differ a little.
  void set_detail_size(std::size_t k, double size, const Progress& progress = {});

  /// What the target became: the mesh given, or one with a finer patch, before anything comes to
  /// it.
  const Mesh& mesh() const { return target_->mesh(); }
  /// Null unless the target was remeshed.
  const RemeshResult* remeshed() const { return target_->remeshed(); }

  std::size_t source_count() const { return layers_.size(); }
  const Patch& source_patch(std::size_t k) const { return layers_[k].source.coating().patch; }
  const Patch& target_patch() const { return target_->patch(); }
  /// How the patches lie on each other in the domain.
  const Correspondence& map(std::size_t k) const { return layers_[k].map; }
  /// w at each vertex of the target patch; empty for one source.
  const std::vector<double>& weights() const { return weights_; }
  const std::vector<TargetHandle>& handles() const { return target_->handles(); }

  /// Vertices of the patch that are neither border nor handle.
  std::size_t free_count() const { return coater_->free().size(); }
  /// Of all stages so far.
  StageTimings timings() const;
  /// What was done, with the figures of `result`, which `positions` gave.
  CoatReport report(const Positions& result) const;
  /// For a person, in the order of the work.
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  struct Layer {
    SourceSide source;
    CorrespondenceOptions pairs;  ///< target vertices as they are called now
    double amplitude = 1.0;
    LaidPatch laid_target = {};
    Correspondence map = {};
  };
  template <class Body>
  void timed(const char* name, const Progress& progress, Body body);
  void make_sides(const Progress& progress);
  void lay_target();
  void meet();
  void remesh_where_coarse(const Progress& progress);
  double target_size() const;
  double ratio(const Layer& layer) const;
  double of_both(double first, double second) const;
  CoaterOptions coater_options() const;
  void make_coater();
  void take(const Progress& progress);
  void note_held_scales();
  void note_wide_transition();

  const LayeredRequest request_;
  const Mesh& mesh_;
  Kernels& kernels_;
  std::vector<Layer> layers_;
  std::optional<TargetSide> target_;
  std::vector<double> weights_;
  CoaterOptions options_;
  std::optional<Coater> coater_;
  std::size_t vertices_before_remeshing_ = 0;
  StageTimings timings_;
  std::vector<std::string> warnings_;
};

}  // namespace lapwing
